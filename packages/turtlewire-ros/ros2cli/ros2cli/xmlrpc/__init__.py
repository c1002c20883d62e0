"""Remote calls on one host, as ROS 2's daemon takes them; here extensions may use them."""
