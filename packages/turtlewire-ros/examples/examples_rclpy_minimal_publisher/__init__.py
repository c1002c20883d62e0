"""ROS 2's minimal examples: A publisher in three styles.

===========================  ====================================
module                       contents
===========================  ====================================
`publisher_local_function`   the timer calls a local function
`publisher_member_function`  the timer calls a method of the node
`publisher_old_school`       a loop that sleeps
===========================  ====================================
"""
