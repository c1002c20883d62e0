"""The command ``ros2 interface``, and its functions for programs and extensions.

=========  ===============================
module     what it holds
=========  ===============================
`api`      interfaces as YAML, completions
`command`  the command ``ros2 interface``
`verb`     its verbs
=========  ===============================
"""
