"""ROS 2's examples of executors: several nodes, threads and callback groups in one process.

=======================  ============================================================
module                   contents
=======================  ============================================================
`callback_group`         two timers that exclude each other, on four threads
`composed`               the talker and the listener on one thread
`custom_callback_group`  a group that lets its callbacks run now and then only
`custom_executor`        an executor with threads for nodes of high priority
`listener`               logs the messages on ``chatter``
`talker`                 says ``Hello World`` on ``chatter`` once a second
=======================  ============================================================
"""
