"""``ros2 action``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ========================================
module     what it holds
=========  ========================================
`api`      actions, completions
`command`  the class of the command ``ros2 action``
`verb`     the classes of its verbs
=========  ========================================
"""
