"""Private parts of :class:`rclpy.node.Node`.

============================  ==================================================================
module                        contents
============================  ==================================================================
`base`                        `BaseNode`: the base of ordinary and asynchronous nodes
`state`                       names, wire, context, logger and command line of one node
`endpoints`                   creates, stores and closes the endpoints of a node
`handle`                      the stand-in for a node's handle of the C library
`qos_overrides`               policies of an endpoint that parameters override
`checks`                      checks of callbacks and of the quality of service
`names`                       full names of topics and services
`graph`                       other nodes, topics and services
`declared`, `parameters`      parameters of a node: read and listed; set, with callbacks and
                              events
`declarations`                what a declaration of a parameter means
`descriptors`                 checks a value against its descriptor: ranges, steps, types
`rosout`                      the publisher of ``/rosout``
`views`                       views of a node for the time source and built-in services
============================  ==================================================================
"""
