"""The Foxglove WebSocket server: Foxglove and Lichtblick see the topics of this domain.

Messages are forwarded unchanged: the middleware delivers CDR bytes, and a client gets them after a
header of 13 bytes. :class:`~turtlewire_view.foxglove.server.FoxgloveServer` is the server; it needs
no package of ROS.

==================  ===================================================================
module              contents
==================  ===================================================================
`server`            `FoxgloveServer`: accepts clients, and refuses pages of other sites
`options`           `BridgeOptions`: the topics to serve, the address, the allowed clients
`session`           one client: its requests, one method for each
`publishing`        the topics that one client publishes
`outbox`            the send queue of one client; a slow client loses old messages
`bridge`            the state that all clients share; notifies them of changes
`offers`            the topics and services that clients may use, as the graph has them
`channel`           one topic: its subscriptions, and the clients that receive it
`caller`            calls of services on the wire, for asyncio
`parameters`        the parameters of all nodes: read, set, followed; their values as JSON
`connections`       which node publishes, subscribes and serves what; changes of the graph
`assets`            files of packages
`protocol`          the frames of the protocol; fields of clients' requests, checked
`schemas`           definitions of types, requests and responses
==================  ===================================================================
"""

from turtlewire_view.foxglove.options import BridgeOptions
from turtlewire_view.foxglove.server import FoxgloveServer

__all__ = ["BridgeOptions", "FoxgloveServer"]
