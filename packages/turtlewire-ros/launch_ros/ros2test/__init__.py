"""The command ``ros2 test``, and its functions for programs and extensions.

=========  =========================
module     what it holds
=========  =========================
`command`  the command ``ros2 test``
=========  =========================
"""
