"""Parts of :mod:`rclpy.logging`, under the paths that they have in ROS 2, and of this package.

==========================  ==============================================================
module                      contents
==========================  ==============================================================
`arguments`                 ROS arguments, and the nodes that they are for
`excepthooks`               Ctrl-C without a traceback at the end of a process
`hints`                     advice for common mistakes
`unheard`                   a warning when nothing subscribes to a publisher
`failed_lookups`            repeated log lines about failed lookups, shortened
`log_*`                     outputs, formats and levels of logs
`logging_severity`          the severities of log messages
`rcutils_logger`            the logger of a node
`rcl_*`                     the languages of remap rules and of parameter files
`reexports`                 names that ROS 2's modules import, and programs too
`implementation_singleton`  ROS 2's name of the C extension
==========================  ==============================================================
"""
