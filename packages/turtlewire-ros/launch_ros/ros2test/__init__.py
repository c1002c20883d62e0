"""The command ``ros2 test``, and its functions for programs and extensions.

=========  =========================
module     contents
=========  =========================
`command`  the command ``ros2 test``
=========  =========================
"""
