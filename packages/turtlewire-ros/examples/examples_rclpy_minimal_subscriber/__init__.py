"""ROS 2's minimal examples: A subscription in three styles.

============================  ===================================
module                        contents
============================  ===================================
`subscriber_lambda`           messages go to a lambda
`subscriber_member_function`  messages go to a method of the node
`subscriber_old_school`       `spin_once` in a loop
============================  ===================================
"""
