"""The command ``ros2 node``, and its functions for programs and extensions.

=========  =====================================
module     contents
=========  =====================================
`api`      nodes and what they have, completions
`command`  the command ``ros2 node``
`verb`     its verbs
=========  =====================================
"""
