"""The command ``ros2 service``, and its functions for programs and extensions.

===========  =======================================
module       what it holds
===========  =======================================
`api`        services and their classes, completions
`command`    the command ``ros2 service``
`verb`       its verbs
===========  =======================================
"""
