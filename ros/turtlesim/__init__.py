"""turtlesim: the simulator of ROS 2's tutorials, with its screen in the browser."""
