"""``ros2 launch``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ========================================
module     what it holds
=========  ========================================
`api`      launch files: found, shown, run
`command`  the class of the command ``ros2 launch``
`option`   options that other packages add
=========  ========================================
"""
