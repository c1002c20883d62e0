"""What a :class:`rclpy.node.Node` is made of; none of it is ROS 2's public surface.

============================  ==================================================================
module                        what it holds
============================  ==================================================================
`core`                        names, wire, context, logger and command line of one node
`endpoints`                   makes, keeps and closes what a node owns
`graph`                       other nodes, topics and services
`parameters`, `declarations`  parameters of a node, with callbacks and events; their declaration
`descriptors`                 checks a value against its descriptor: ranges, steps, types
`rosout`                      the publisher of ``/rosout``
`views`                       what time source and built-in services need of a node
============================  ==================================================================
"""
