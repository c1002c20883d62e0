"""The ros2 command.

Commands and verbs are entry points of this distribution and of others, for example
:mod:`ros2topic.command.topic` and :mod:`ros2topic.verb.echo`. Only those on the command line are
loaded.

=================================  ========================================================
module                             contents
=================================  ========================================================
`main`                             the command and its help
`arguments`                        command lines of verbs as data
`completion`                       completions for TAB
`discovery`                        joins a domain long enough to discover its nodes
`graph`, `listing`                 nodes and topics; the verbs ``list``, ``find``, ``type``
`qos`                              QoS on the command line
`message_text`                     messages as YAML or CSV; the options of ``echo``
`json_lines`                       the option ``--json``
`endpoint_data`                    publishers, servers and so on as plain data
`interface_names`                  installed interfaces
`values`                           YAML values on the command line
`output`                           printing without control characters of other processes
`suggestion`                       suggestions for misspelt names
`selection`                        choosing from a list in the terminal
`cli`, `helpers`                   ``ros2`` called by programs; functions for extensions
`command`, `verb`                  ROS 2's classes of commands and verbs
`installed`                        finds entry points quickly
`entry_points`, `plugin_system`    ROS 2's functions for entry points and extensions
`extension`                        runs extensions of other packages
`node`                             the rclpy node of verbs, under ROS 2's names
`xmlrpc`                           remote calls on this host
`daemon`                           answers these calls about the graph
`background`                       runs a function in a process that stays
=================================  ========================================================
"""
