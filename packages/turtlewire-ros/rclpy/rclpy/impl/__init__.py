"""Parts of :mod:`rclpy.logging`, under the paths that they have in ROS 2."""
