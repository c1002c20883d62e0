"""ROS 2's demo nodes in Python: talkers, listeners and services to try the tools on.

============  ========================================================
module        contents
============  ========================================================
`events`      publishers and subscriptions notified of each other
`logging`     the services that change the level of a logger
`parameters`  parameters of other nodes, and callbacks of one's own
`services`    a service that adds integers, its clients, introspection
`spin`        how every demo runs its node
`topics`      talkers and listeners
============  ========================================================
"""
