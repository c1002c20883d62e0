"""Private parts of :mod:`rclpy.qos` and :mod:`rclpy.event_handler`.

===============  =================================================================
module           contents
===============  =================================================================
`policies`       the policies of a quality of service and their values
`compatibility`  which offered and requested profiles match, with ROS 2's reasons
`events`         the events of an endpoint's QoS
===============  =================================================================
"""
