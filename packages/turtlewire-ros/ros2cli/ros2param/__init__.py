"""The command ``ros2 param``, and its functions for programs and extensions.

============  ======================================
module        contents
============  ======================================
`api`         parameters of other nodes, completions
`command`     the command ``ros2 param``
`verb`        its verbs
`options`     options that its verbs share
`parameters`  calls to parameter services
============  ======================================
"""
