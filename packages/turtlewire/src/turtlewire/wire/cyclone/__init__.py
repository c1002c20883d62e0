"""Cyclone DDS through a thin ctypes layer.

It loads ``libddsc`` from the ``cyclonedds`` wheel (11.0), without the wheel's Python classes, or
from a ROS 2 installation or the system (0.10); :mod:`turtlewire.wire.libddsc` chooses.

Every message is an opaque block of bytes to the middleware, as in rmw_cyclonedds. No thread of
Cyclone ever calls a Python function: Python threads wait in C, without the GIL, for data and
changes of the graph.

A process must not fork after it opened a context (start children with ``spawn`` or ``subprocess``):
Cyclone's threads do not survive a fork.

========================  =======================================================
module                    contents
========================  =======================================================
`library`                 loads ``libddsc``, and declares its functions
`configuration`           Cyclone's configuration for a domain
`context`                 one participant
`participant`             the DDS participant and its topics
`node`                    creates endpoints, and announces them
`announcer`               publishes ``ros_discovery_info``
`endpoint`                the common base of publishers and subscriptions
`publisher`               bytes to a DDS writer
`subscription`            bytes from a DDS reader
`samples`                 takes and writes samples, by native code or through ctypes
`native`                  the compiled half of this package, or None; the way to a native sink
`services`                services in the layouts of rmw_cyclonedds and Fast DDS
`servers`                 chooses the servers that get requests
`fast_dds`                prepares the types of services for nodes on Fast DDS, and asks new clients
                          on it for their first request
`waiting`                 wait sets
`reader`                  the Python thread of a context
`graph`                   this participant's view of the graph
`silent_peers`            requests messages that Cyclone missed
`qos`                     QoS as Cyclone's objects, and back
`log`                     Cyclone's warnings, explained and limited
`ports`                   the processes of this host that take part in a domain
========================  =======================================================
"""
