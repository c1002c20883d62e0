"""``ros2 doctor``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ========================================
module     what it holds
=========  ========================================
`api`      checks and reports, own ones and others'
`command`  the class of the command ``ros2 doctor``
`verb`     the classes of its verbs
=========  ========================================
"""
