"""How executors wait, decide what runs next, and run it; none of it is ROS 2's public surface."""
