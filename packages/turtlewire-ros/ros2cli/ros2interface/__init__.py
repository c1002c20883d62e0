"""The command ``ros2 interface``, and its functions for programs and extensions.

=========  ===============================
module     contents
=========  ===============================
`api`      interfaces as YAML, completions
`command`  the command ``ros2 interface``
`verb`     its verbs
=========  ===============================
"""
