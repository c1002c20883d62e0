"""``ros2 test``, for programs and extensions; :mod:`ros2cli` does the work.

=========  ======================================
module     what it holds
=========  ======================================
`command`  the class of the command ``ros2 test``
=========  ======================================
"""
