"""The command ``ros2 launch``, and its functions for programs and extensions.

====================  ==========================================
module                contents
====================  ==========================================
`api`                 launch files: found, shown, run
`command`             the command ``ros2 launch``
`option`              options that other packages add
`suppress_completer`  a completer that completes nothing
====================  ==========================================
"""
