"""Waits for many entities at once: a ``dds_waitset`` with a guard condition that wakes it."""

from __future__ import annotations

import ctypes
import os
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar

from turtlewire.wire.base import Entity, WaitSet
from turtlewire.wire.events import EventWatcher, StatusEvent
from turtlewire.wire.services import TopicClient, TopicService

from . import library as dds
from .native import NATIVE, address_of
from .subscription import CycloneSubscription

if TYPE_CHECKING:
    from turtlewire.wire.base import Waitable

T = TypeVar("T")

_GUARD = 0
_wait = dds.wait_set_wait if NATIVE is None else NATIVE.wait


class ConditionSet(Generic[T]):
    """Conditions (or entities with statuses) and the object that :meth:`wait` returns for each."""

    def __init__(self, participant: int) -> None:
        self._wait_set = dds.check(dds.create_wait_set(participant), "create a wait set")
        self._guard = dds.check(dds.create_guard_condition(participant), "create a guard condition")
        dds.check(
            dds.wait_set_attach(self._wait_set, self._guard, _GUARD), "attach a guard condition"
        )
        self._objects: dict[int, T] = {}
        self._triggered = (ctypes.c_int64 * 16)()
        self._lock = threading.Lock()
        self._closed = False
        self._process = os.getpid()

    def attach(self, condition: int, returned: T) -> None:
        """Include a condition, or an entity whose enabled statuses count."""
        with self._lock:
            self._objects[condition] = returned
            if len(self._objects) >= len(self._triggered):
                self._triggered = (ctypes.c_int64 * (4 * len(self._objects)))()
        dds.check(dds.wait_set_attach(self._wait_set, condition, condition), "attach to a wait set")

    def detach(self, condition: int) -> None:
        """Exclude it; nothing happens when it is not attached."""
        with self._lock:
            attached = self._objects.pop(condition, None) is not None
        if attached:
            dds.wait_set_detach(self._wait_set, condition)

    def wait(self, timeout_ns: int | None) -> list[T]:
        """Block until something is triggered or :meth:`wake` is called; one thread at a time."""
        triggered = self._triggered
        count = _wait(self._wait_set, triggered, len(triggered), dds.duration(timeout_ns))
        if count < 0:
            if self._closed:
                return []
            dds.check(count, "wait")
        found = []
        for index in range(min(count, len(triggered))):
            token = triggered[index]
            if token == _GUARD:
                if not self._closed:
                    dds.set_guard_condition(self._guard, False)
            elif (
                triggered_object := self._objects.get(token)
            ) is not None:  # None: detached by another thread
                found.append(triggered_object)
        return found

    def wake(self) -> None:
        """End the current or the next wait."""
        dds.set_guard_condition(self._guard, True)

    @property
    def guard(self) -> int:
        """The guard condition that :meth:`wake` triggers."""
        return self._guard

    def close(self) -> list[T]:
        """End the waits, now and in the future, and delete. Idempotent.

        Returns:
            What was attached.
        """
        if self._process != os.getpid():  # see `Entity.close`
            return []
        with self._lock:
            if self._closed:
                return []
            self._closed = True
            attached, self._objects = list(self._objects.values()), {}
        self.wake()
        dds.delete(self._wait_set)
        dds.delete(self._guard)
        return attached


class CycloneWaitSet(EventWatcher, WaitSet):
    """The wait set of an executor."""

    def __init__(self, participant: int, on_closing: Callable[[CycloneWaitSet], None]) -> None:
        super().__init__()
        self._on_closing = on_closing
        self._conditions: ConditionSet[Entity] = ConditionSet(participant)

    def attach(self, entity: Waitable) -> None:
        if isinstance(entity, StatusEvent):
            entity.attach(self)
        else:
            subscription = readable_part(entity)
            self._conditions.attach(subscription.condition(), entity)
            subscription.wait_sets.add(self)

    def detach(self, entity: Waitable) -> None:
        if isinstance(entity, StatusEvent):
            entity.detach(self)
        else:
            subscription = readable_part(entity)
            if self in subscription.wait_sets:  # a closed one has no condition to be asked for
                subscription.wait_sets.discard(self)
                self._conditions.detach(subscription.condition())

    def wait(self, timeout_ns: int | None = None) -> list[Entity]:
        if self._happened and self.ready_events():
            timeout_ns = 0
        ready = self._conditions.wait(timeout_ns)
        if self._happened:
            ready += self.ready_events()
        return ready

    def wake(self) -> None:
        self._conditions.wake()

    def native_waker(self) -> tuple[int, int] | None:
        return address_of(dds.set_guard_condition), self._conditions.guard

    def close(self) -> None:
        self._on_closing(self)
        self.leave_events()
        for entity in self._conditions.close():
            readable_part(entity).wait_sets.discard(self)


def readable_part(entity: Entity) -> CycloneSubscription:
    """Return the subscription that makes an entity ready."""
    if isinstance(entity, TopicClient):
        entity = entity.replies
    elif isinstance(entity, TopicService):
        entity = entity.requests
    assert isinstance(entity, CycloneSubscription)
    return entity
