"""Publishes the joint states of a robot that has no drivers: values by parameter or by topic.

=======================  =====================================
module                   contents
=======================  =====================================
`description`            the joints of a URDF or SDF text
`joint_state_publisher`  `JointStatePublisher`, the node
`joints`                 joints with their values, without ROS
=======================  =====================================
"""
