"""The command ``ros2 component``, and its functions for programs and extensions.

============  =============================================
module        contents
============  =============================================
`api`         components, and those in containers
`command`     the command ``ros2 component``
`verb`        its verbs
`containers`  the options of verbs, and calls to containers
============  =============================================
"""
