"""Cyclone DDS through a thin ctypes layer.

``libddsc`` of the ``cyclonedds`` wheel (11.0), without the wheel's Python classes, or that of a
ROS 2 installation or the system (0.10); :mod:`turtlewire.wire.libddsc` chooses.

Every message is an opaque block of bytes to the middleware, as in rmw_cyclonedds. No Python
function is ever called from a thread of Cyclone's: data and changes of the graph are waited for in
C, without the GIL, and taken by Python threads.

A process must not fork after it opened a context (start children with ``spawn`` or ``subprocess``):
Cyclone's threads do not survive a fork.

========================  =======================================================
module                    what it holds
========================  =======================================================
`library`                 loads ``libddsc``, and declares its functions
`sertype`                 the type of a topic, of which samples are made
`configuration`           Cyclone's configuration for a domain
`context`                 one participant
`context_state`           what a context shares with its nodes
`participant`             the DDS participant and its topics
`node`                    makes endpoints, and announces them
`announcer`               publishes ``ros_discovery_info``
`endpoint`                what publishers and subscriptions have in common
`publisher`, `writing`    bytes to a DDS writer
`subscription`, `taking`  bytes from a DDS reader
`inlet`                   messages that Cyclone's thread hands to a native sink
`native`                  the compiled half of this package, or None
`services`                services as rmw_cyclonedds spells them
`servers`                 which servers get requests, and why others get none
`fast_dds`                prepares the types of services for nodes on Fast DDS
`identified_requests`     requests to servers on Fast DDS
`first_requests`          asks new clients on Fast DDS for their first request
`waiting`                 wait sets
`reader`                  the one Python thread of a context
`graph`                   the graph as this participant sees it
`silent_peers`            asks peers again for messages that Cyclone missed
`qos`                     QoS as Cyclone's objects, and back
`log`                     Cyclone's warnings, explained and bounded
`ports`                   the processes of this host that take part in a domain
========================  =======================================================
"""
