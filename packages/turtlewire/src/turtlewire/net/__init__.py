"""Topics and transforms of a ROS network without ROS's names: ``turtlewire.connect``.

==============  ===================================================================
module          contents
==============  ===================================================================
`connection`    `connect` and `Connection`, which make the rest
`publisher`     `Publisher`: messages out; the transforms that a connection sends
`subscription`  `Subscription`: messages in, with ``for`` and ``async for``
==============  ===================================================================
"""

from turtlewire.net.connection import Connection, connect
from turtlewire.net.publisher import Publisher
from turtlewire.net.subscription import Subscription

__all__ = ["Connection", "Publisher", "Subscription", "connect"]
