"""Parts that programs reach through :mod:`rclpy.logging`, under the paths that they have in ROS 2."""
