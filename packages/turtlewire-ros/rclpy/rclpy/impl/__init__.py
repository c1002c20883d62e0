"""Parts of :mod:`rclpy.logging`, under the paths that they have in ROS 2, and of this package.

=============  ==============================================================
module         contents
=============  ==============================================================
`arguments`    ROS arguments, and the nodes that they are for
`excepthooks`  Ctrl-C without a traceback at the end of a process
`hints`        advice for common mistakes
`unheard`      a warning when nothing subscribes to a publisher
`log_*`        outputs, formats and levels of logs
`rcl_*`        the languages of remap rules and of parameter files
=============  ==============================================================
"""
