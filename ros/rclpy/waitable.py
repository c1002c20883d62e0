"""Waitables: entities that programs make of other entities."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .entity import Entity

if TYPE_CHECKING:
    from .callback_groups import CallbackGroup

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

    def __iadd__(self, other: NumberOfEntities) -> NumberOfEntities:
        for kind in self.__slots__:
            setattr(self, kind, getattr(self, kind) + getattr(other, kind))
        return self

    def __repr__(self) -> str:
        counts = ", ".join(str(getattr(self, kind)) for kind in self.__slots__)
        return f"<{self.__class__.__name__}({counts})>"
