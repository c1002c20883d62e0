"""ROS 2's minimal examples: Action servers for Fibonacci sequences.

=======================  =============================================================
module                   contents
=======================  =============================================================
`server`                 feedback once a second, cancellation, several goals at a time
`server_defer`           executes a goal three seconds after it was accepted
`server_not_composable`  functions, without a class for the node
`server_queue_goals`     executes goals one after the other
`server_single_goal`     a new goal aborts the running one
=======================  =============================================================
"""
