"""ROS 2's demo nodes in Python: talkers, listeners and services to try the tools on.

==========  =============================================
module      what it holds
==========  =============================================
`services`  a service that adds integers, and its clients
`spin`      how every demo runs its node
`topics`    talkers and listeners
==========  =============================================
"""
