"""ROS 2's experimental API: nodes for asyncio, and the events executor.

======================  ==========================================================================
module                  contents
======================  ==========================================================================
`async_node`            `AsyncNode`
`async_publisher`       its publishers, and in modules named likewise:
`async_subscription`    subscriptions, to be iterated as well
`async_service`         services
`async_client`          clients, whose calls are awaited
`async_timer`           timers
`async_clock`           its clock, whose sleeps are awaited
`_async_entity`         runs the callbacks of these entities
`events_executor`       `EventsExecutor`
======================  ==========================================================================
"""

from .async_client import AsyncClient
from .async_clock import AsyncClock
from .async_node import AsyncNode
from .async_publisher import AsyncPublisher
from .async_service import AsyncService
from .async_subscription import AsyncSubscription
from .async_timer import AsyncTimer
from .events_executor import EventsExecutor

__all__ = [
    "AsyncClient",
    "AsyncClock",
    "AsyncNode",
    "AsyncPublisher",
    "AsyncService",
    "AsyncSubscription",
    "AsyncTimer",
    "EventsExecutor",
]
