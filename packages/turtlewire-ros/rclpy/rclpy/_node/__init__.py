"""Private parts of :class:`rclpy.node.Node`.

============================  ==================================================================
module                        contents
============================  ==================================================================
`base`                        `BaseNode`: the base of ordinary and asynchronous nodes
`state`                       names, wire, context, logger and command line of one node; the
                              publisher of ``/rosout``
`endpoints`                   creates, stores and closes the endpoints of a node
`checks`                      checks of callbacks, names and the quality of service
`graph`                       other nodes, topics and services
`declared`, `parameters`      parameters of a node: read and listed; set, with callbacks and
                              events
`graph_methods`               methods of `BaseNode` that show the graph
`parameter_methods`           methods of `BaseNode` for its parameters
`declarations`                what a declaration of a parameter means; checks of a value: ranges,
                              steps, types
`views`                       views of a node for the time source and built-in services
============================  ==================================================================
"""
