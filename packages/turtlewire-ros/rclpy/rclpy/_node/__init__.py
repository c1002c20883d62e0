"""What a :class:`rclpy.node.Node` is made of; none of it is ROS 2's public surface.

============================  ==================================================================
module                        what it holds
============================  ==================================================================
`base`                        `BaseNode`: what ordinary and asynchronous nodes share
`state`                       names, wire, context, logger and command line of one node
`endpoints`                   makes, keeps and closes what a node owns
`checks`                      checks of callbacks and of the quality of service
`names`                       full names of topics and services
`graph`                       other nodes, topics and services
`declared`, `parameters`      parameters of a node: read and listed; set, with events
`declarations`                what a declaration of a parameter means
`callbacks`                   callbacks that see, change and decide about parameters
`prefixes`                    prefixes of parameters' names
`descriptors`                 checks a value against its descriptor: ranges, steps, types
`rosout`                      the publisher of ``/rosout``
`views`                       what time source and built-in services need of a node
============================  ==================================================================
"""
