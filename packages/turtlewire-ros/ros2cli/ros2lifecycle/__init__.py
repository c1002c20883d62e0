"""``ros2 lifecycle``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ===========================================
module     what it holds
=========  ===========================================
`api`      states and transitions of managed nodes
`command`  the class of the command ``ros2 lifecycle``
`verb`     the classes of its verbs
=========  ===========================================
"""
