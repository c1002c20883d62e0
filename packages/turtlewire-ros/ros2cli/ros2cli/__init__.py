"""The ros2 command.

Commands and verbs are entry points of this distribution and of others, for example
:mod:`ros2topic.command.topic` and :mod:`ros2topic.verb.echo`. Only those on the command line are
loaded.

==================  ========================================================
module              contents
==================  ========================================================
`main`              the command and its help
`arguments`         command lines of verbs as data, and their values
`completion`        completions for TAB, such as all interfaces
`discovery`         joins a domain long enough to discover its nodes
`graph`, `listing`  nodes and topics; the verbs ``list``, ``find``, ``type``
`qos`               QoS on the command line
`message_text`      messages as YAML or CSV; the options of ``echo``
`json_lines`        the option ``--json``
`output`            printing without control characters of other processes
`suggestion`        suggestions for misspelt names
`cli`               ``ros2`` called by programs
`helpers`           choosing from a list; functions for extensions
`command`, `verb`   ROS 2's classes of commands and verbs
`entry_points`      finds entry points quickly
`plugin_system`     extensions of other packages
`node`              the rclpy node of verbs, under ROS 2's names
`xmlrpc`            remote calls on this host
`daemon`            answers these calls about the graph
`background`        runs a function in a process that stays
==================  ========================================================
"""
