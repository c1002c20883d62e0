"""ROS 2's minimal examples: Clients of the action server for Fibonacci sequences.

===============  =====================================
module           what it holds
===============  =====================================
`client`         sends a goal and waits for its result
`client_cancel`  cancels its goal after two seconds
===============  =====================================
"""
