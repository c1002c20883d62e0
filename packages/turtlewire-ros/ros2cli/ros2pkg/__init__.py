"""``ros2 pkg``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ========================================
module     what it holds
=========  ========================================
`api`      installed packages and their executables
`command`  the class of the command ``ros2 pkg``
`verb`     the classes of its verbs
=========  ========================================
"""
