"""``ros2 bag``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ========================================
module     what it holds
=========  ========================================
`api`      values on the command line, QoS profiles
`command`  the class of the command ``ros2 bag``
`verb`     the classes of its verbs
=========  ========================================
"""
