"""The command ``ros2 run``, and its functions for programs and extensions.

=========  ===========================
module     what it holds
=========  ===========================
`api`      executables: found and run
`command`  the command ``ros2 run``
`child`    a program in the foreground
=========  ===========================
"""
