"""The types of interface fields, as ROS 2's package of this name."""
