"""Waitables: entities that programs make of other entities."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .entity import Entity

if TYPE_CHECKING:
    from typing_extensions import Self

    from .callback_groups import CallbackGroup
    from .executors import Executor
    from .task import Future

__all__ = ["NumberOfEntities", "Waitable"]


class NumberOfEntities:
    """How many entities of each kind a waitable waits for."""

    __slots__ = ["num_clients", "num_events", "num_guard_conditions", "num_services", "num_subscriptions", "num_timers"]

    def __init__(
        self,
        num_subs: int = 0,
        num_gcs: int = 0,
        num_timers: int = 0,
        num_clients: int = 0,
        num_services: int = 0,
        num_events: int = 0,
    ) -> None:
        self.num_subscriptions = num_subs
        self.num_guard_conditions = num_gcs
        self.num_timers = num_timers
        self.num_clients = num_clients
        self.num_services = num_services
        self.num_events = num_events

    def __add__(self, other: NumberOfEntities) -> NumberOfEntities:
        total = NumberOfEntities()
        for kind in self.__slots__:
            setattr(total, kind, getattr(self, kind) + getattr(other, kind))
        return total

    def __iadd__(self, other: NumberOfEntities) -> Self:
        for kind in self.__slots__:
            setattr(self, kind, getattr(self, kind) + getattr(other, kind))
        return self

    def __repr__(self) -> str:
        counts = ", ".join(str(getattr(self, kind)) for kind in self.__slots__)
        return f"<{self.__class__.__name__}({counts})>"


class Waitable(Entity):
    """Something an executor serves that consists of several entities.

    The executor serves the parts; to the outside they are one: they come and go together, and run before the other entities of a cycle.
    """

    _ORDER = -1

    def __init__(self, callback_group: CallbackGroup) -> None:
        super().__init__(callback_group)
        self._parts: list[Entity] = []

    def add_future(self, future: Future) -> None:
        """Have the done-callbacks of ``future`` run on the executor that serves this waitable."""
        executor = None if self._executor is None else self._executor()
        future._set_executor(executor)

    def _attach(self, executor: Executor) -> None:
        for part in self._parts:
            executor._adopt(part)

    def _detach(self, executor: Executor) -> None:
        for part in self._parts:
            executor._detach(part)

    def _close(self) -> None:
        for part in self._parts:
            part.destroy()
