"""Remote calls on one host, as ROS 2's daemon accepts them; extensions may use them."""
