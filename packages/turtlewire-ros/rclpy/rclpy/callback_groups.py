"""Callback groups: which callbacks of a node may run at the same time.

A group holds its entities by weak references; its creator keeps the group alive, as in ROS 2.
"""

from __future__ import annotations

import threading
import weakref
from abc import ABC, abstractmethod
from typing import Any, Protocol


class _Scheduler(Protocol):
    """The part of an executor that pauses entities of busy groups."""

    def resume_paused(self) -> None: ...


class CallbackGroup(ABC):
    """Base of all groups; an executor asks it before it runs a callback. Thread-safe."""

    def __init__(self) -> None:
        self.entities: set[weakref.ref[Any]] = set()
        self._rclpy_schedulers: set[weakref.ref[_Scheduler]] = set()

    def add_entity(self, entity: object) -> None:
        """Make ``entity`` (a subscription, timer, service, …) a member."""
        self.entities.add(weakref.ref(entity, self.entities.discard))

    def has_entity(self, entity: object) -> bool:
        """Return True if ``entity`` is a member."""
        return weakref.ref(entity) in self.entities

    def _rclpy_note_wait(self, scheduler: _Scheduler) -> None:
        """Let :meth:`_rclpy_wake_schedulers` wake this scheduler."""
        self._rclpy_schedulers.add(weakref.ref(scheduler, self._rclpy_schedulers.discard))

    def _rclpy_wake_schedulers(self) -> None:
        """Wake all schedulers that found the group busy, to check it again."""
        # All, because a node that moves to another executor leaves a running callback behind: the
        # scheduler that ends it is then not the one that has entities of this group.
        for reference in tuple(self._rclpy_schedulers):
            scheduler = reference()
            if scheduler is not None:
                scheduler.resume_paused()

    @abstractmethod
    def can_execute(self, entity: object) -> bool:
        """Return True if the callback of ``entity`` might start now."""

    @abstractmethod
    def beginning_execution(self, entity: object) -> bool:
        """Claim the group for ``entity``; False when its callback must not start now."""

    @abstractmethod
    def ending_execution(self, entity: object) -> None:
        """Give back what :meth:`beginning_execution` claimed."""


class ReentrantCallbackGroup(CallbackGroup):
    """Lets callbacks run at the same time, also several of one entity."""

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002
        return True

    def beginning_execution(self, entity: object) -> bool:  # noqa: ARG002
        return True

    def ending_execution(self, entity: object) -> None:
        """Nothing was claimed."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Lets one callback run at a time.

    An ``async def`` callback counts as running until it has returned.
    """

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: object | None = None
        self._lock = threading.Lock()

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002
        """Return True if no callback of the group is running."""
        return self._active_entity is None

    def beginning_execution(self, entity: object) -> bool:
        """Claim the group unless a callback of it is running."""
        with self._lock:
            if self._active_entity is not None:
                return False
            self._active_entity = entity
            return True

    def ending_execution(self, entity: object) -> None:
        """Open the group for the next callback."""
        with self._lock:
            if self._active_entity is not entity:
                raise RuntimeError(f"{entity!r} ends an execution in a group that it does not hold")
            self._active_entity = None
