"""The command ``ros2 launch``, and its functions for programs and extensions.

=========  ===============================
module     what it holds
=========  ===============================
`api`      launch files: found, shown, run
`command`  the command ``ros2 launch``
`option`   options that other packages add
=========  ===============================
"""
