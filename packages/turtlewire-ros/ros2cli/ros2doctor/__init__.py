"""The command ``ros2 doctor``, and its functions for programs and extensions.

=========  ==========================================
module     what it holds
=========  ==========================================
`api`      checks and reports, own ones and others'
`command`  the command ``ros2 doctor``
`verb`     its verbs
=========  ==========================================
"""
