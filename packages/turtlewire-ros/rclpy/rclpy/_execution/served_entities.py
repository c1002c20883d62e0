"""The entities that an executor serves: they come, go and are parked with their nodes."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from turtlewire.errors import WireError

from .blocking import SelfWaits
from .membership import Membership

if TYPE_CHECKING:
    from rclpy.context import Context

    from .entity import Entity
    from .wait import ExecutorWait


class ServedEntities:
    """The entities that an executor serves: of its nodes, and some without a node.

    Attributes:
        context: Its context.
        wait: The wait for everything that can become ready.
        is_shutdown: Whether the executor was shut down.
        lock: Guards the state of it all.
    """

    def __init__(self, context: Context, wait: ExecutorWait[Entity]) -> None:
        self.context = context
        self.wait = wait
        self.is_shutdown = False
        self.lock = threading.RLock()
        self._entities_made = 0
        self._without_node = Membership(self, -1)
        self._members = {self._without_node: None}
        self._paused: set[Entity] = set()
        self._self_waits = SelfWaits()

    def served(self) -> list[Entity]:
        """Return the entities; the caller holds the lock."""
        return [entity for member in self._members for entity in member.entities]

    def adopt(self, entity: Entity, membership: Membership | None = None) -> None:
        """Serve an entity of a node; entities without a node come first.

        While the node is parked, that begins when it is taken back.
        """
        with self.lock:
            if membership is None:
                membership = self._without_node
            if membership.is_over:
                return
            self._entities_made += 1
            if not entity._join(membership, self._entities_made):
                return
            self._before_change(membership)
            membership.entities[entity] = None
            if membership.is_active:
                self._members[membership] = None
                self._listen_to(entity, entity._attach)

    def release(self, entity: Entity) -> None:
        """Serve an entity no longer."""
        with self.lock:
            membership = entity._membership
            if membership is not None:
                self._before_change(membership)
                membership.entities.pop(entity, None)
            self._forget_pause(entity)
            entity._leave(self)  # type: ignore[arg-type]  # the derived `Scheduler` is a host

    def _before_change(self, membership: Membership) -> None:
        """Attach the endpoints one by one when the node is taken back."""
        if not membership.is_active:
            self.wait.detach_parked()
        membership.by_wire = None

    def _forget_pause(self, entity: Entity) -> None:
        if entity in self._paused:
            self._paused.discard(entity)
            self._self_waits.goes_on(entity)

    def park(self, membership: Membership) -> None:
        """Serve the entities of a node no longer; its endpoints stay attached for the moment."""
        with self.lock:
            self._members.pop(membership, None)
            if self._paused:  # perhaps some of its entities, which are not attached
                for entity in list(membership.entities):
                    self._forget_pause(entity)
                    entity._detach(self)
                membership.by_wire = None
                membership.is_active = False
                return
            membership.is_active = False
            self.wait.park(membership)
            for entity in membership.others:
                entity._pause(self)

    def take_back(self, membership: Membership) -> None:
        """Serve the entities of a parked node again."""
        with self.lock:
            self._members[membership] = None
            membership.is_active = True
            if self.wait.take_back(membership):
                for entity in membership.others:
                    self._listen_to(entity, entity._resume)
            else:
                for entity in list(membership.entities):
                    self._listen_to(entity, entity._attach)

    def end_membership(self, membership: Membership) -> None:
        """Detach the entities of a parked node, which will not be taken back."""
        with self.lock:
            membership.is_over = True
            self.wait.detach_parked()

    def _listen_to(self, entity: Entity, attach: Callable[[Any], None]) -> None:
        """Attach an entity; another thread may destroy it, or shut down, at this moment."""
        try:
            attach(self)
        except WireError:
            if self.context.ok() and not self.is_shutdown and not entity._destroyed:
                raise
