"""The ``turtlewire`` command: what one looks at and checks without any ROS."""
