"""The command ``ros2 action``, and its functions for programs and extensions.

=========  ===========================
module     contents
=========  ===========================
`api`      actions, completions
`command`  the command ``ros2 action``
`verb`     its verbs
=========  ===========================
"""
