"""The command ``ros2 service``, and its functions for programs and extensions.

===========  =======================================
module       contents
===========  =======================================
`api`        services and their classes, completions
`command`    the command ``ros2 service``
`verb`       its verbs
===========  =======================================
"""
