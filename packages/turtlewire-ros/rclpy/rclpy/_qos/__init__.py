"""Parts of :mod:`rclpy.qos` and :mod:`rclpy.event_handler`; none is ROS 2's public surface.

===============  =================================================================
module           what it holds
===============  =================================================================
`policies`       the policies of a quality of service and their values
`compatibility`  which offered and requested profiles match, with ROS 2's reasons
`events`         the events of an endpoint's QoS
===============  =================================================================
"""
