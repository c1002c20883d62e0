"""The command ``ros2 doctor``, and its functions for programs and extensions.

=========  ==========================================
module     contents
=========  ==========================================
`api`      checks and reports, also from other packages
`command`  the command ``ros2 doctor``
`verb`     its verbs
=========  ==========================================
"""
