"""ROS 2's minimal examples: A service in two styles.

=========================  ===================================
module                     contents
=========================  ===================================
`service`                  requests go to a function
`service_member_function`  requests go to a method of the node
=========================  ===================================
"""
