"""The command ``ros2 lifecycle``, and its functions for programs and extensions.

=========  =======================================
module     contents
=========  =======================================
`api`      states and transitions of managed nodes
`command`  the command ``ros2 lifecycle``
`verb`     its verbs
=========  =======================================
"""
