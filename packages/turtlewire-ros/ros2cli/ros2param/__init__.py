"""The command ``ros2 param``, and its functions for programs and extensions.

============  ========================================
module        contents
============  ========================================
`api`         parameters of other nodes, completions
`command`     the command ``ros2 param``
`verb`        its verbs
`parameters`  the options of verbs, and calls to nodes
============  ========================================
"""
