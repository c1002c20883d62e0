"""The ros2 command.

A command is a module in :mod:`ros2cli.commands`; its verbs, where it has some, are modules beside
it. Nothing is imported before it is needed: only the command and the verb on the command line are
loaded.

=================================  ========================================================
module                             what it holds
=================================  ========================================================
`main`                             the command and its help
`commands`                         one module for each command, with its verbs
`arguments`                        command lines of verbs as data
`completion`                       what TAB offers
`direct_node`                      an rclpy node for verbs that send or receive
`discovery`                        joins a domain long enough to discover its nodes
`graph`, `listing`                 nodes and topics; the verbs ``list``, ``find``, ``type``
`child`                            runs a program in the foreground, for ``ros2 run``
`component_options`, `containers`  components: their options; calls to their containers
`managed_nodes`                    calls to lifecycle nodes
`parameters`, `parameter_options`  calls to parameter services; options of ``ros2 param``
`qos_options`                      QoS on the command line
`topic_type`, `interface_names`    message classes of topics; installed interfaces
`values`                           YAML values on the command line
`bag_options`                      options that verbs of ``ros2 bag`` share
`output`                           printing without control characters of other processes
`suggestion`                       the nearest names to a wrong one
`system_report`                    ``ros2 doctor --report``
`multicast`                        datagrams of ``ros2 multicast``
`package_template`                 files that ``ros2 pkg create`` writes
`cli`, `helpers`                   ``ros2`` called by programs; functions for extensions
`command`, `verb`                  ROS 2's classes of commands and verbs
`builtin`                          our commands and verbs behind these classes
`installed`                        entry points of other packages, found fast
`entry_points`, `plugin_system`    ROS 2's functions for entry points and extensions
`extension`                        runs extensions of other packages
`node`                             nodes for extensions: direct, strategy, daemon
`xmlrpc`                           remote calls on this host
=================================  ========================================================
"""
