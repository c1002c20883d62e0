"""The entities of a node in an executor."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turtlewire.wire import base


class Membership:
    """The entities of one node that an executor serves, or its entities without a node.

    ``rclpy.spin_once`` adds its node to an executor, and removes it after the call. Its membership
    is only *parked* in between: see :meth:`ExecutorWait.park`. The executor's lock guards it.

    Args:
        host: An `EntityHost`, which serves the entities.
        node_index: The place of the node in the executor's order; -1: the entities have no node.

    Attributes:
        host: A weak reference.
        is_active: False while the node is not in the executor.
        is_over: True once the node has another membership.
        entities: Each `Entity`, in the order in which they were adopted.
        by_wire: The entities that are ready when their side on the wire is; None before it is
            known.
        others: The other entities, such as timers.
    """

    def __init__(self, host: Any, node_index: int) -> None:
        self.host: weakref.ref[Any] = weakref.ref(host)
        self.node_index = node_index
        self.is_active = True
        self.is_over = False
        self.entities: dict[Any, None] = {}
        self.by_wire: dict[base.Waitable, Any] | None = None
        self.others: list[Any] = []
