"""What a :class:`rclpy.node.Node` is made of; none of it is ROS 2's public surface."""
