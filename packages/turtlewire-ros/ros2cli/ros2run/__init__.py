"""The command ``ros2 run``, and its functions for programs and extensions.

=========  ==========================
module     contents
=========  ==========================
`api`      executables: found and run
`command`  the command ``ros2 run``
=========  ==========================
"""
