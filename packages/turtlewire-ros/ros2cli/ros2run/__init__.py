"""``ros2 run``, for programs and extensions; :mod:`ros2cli` does the work.

=========  =====================================
module     what it holds
=========  =====================================
`api`      executables: found and run
`command`  the class of the command ``ros2 run``
=========  =====================================
"""
