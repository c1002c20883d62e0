"""ROS 2's minimal examples: A service's client in four styles.

==============================  =================================================
module                          contents
==============================  =================================================
`client`                        spins until the answer has arrived
`client_async`                  looks for the answer between calls of `spin_once`
`client_async_callback`         awaits the answer in the callback of a timer
`client_async_member_function`  asks in a method of the node
==============================  =================================================
"""
