"""What makes a prefix of the ROS packages in this distribution: where they are, what can be run, what a shell must know."""
