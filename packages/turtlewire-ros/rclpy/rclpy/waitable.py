"""Waitables: entities that programs combine from other entities."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._execution.entity import Entity, EntityHost, Work
from .subscription import Subscription
from .timer import Timer

if TYPE_CHECKING:
    from typing_extensions import Self

    from .callback_groups import CallbackGroup
    from .guard_condition import GuardCondition
    from .task import Future


class NumberOfEntities:
    """The number of entities of each kind that a waitable waits for."""

    __slots__ = [
        "num_clients",
        "num_events",
        "num_guard_conditions",
        "num_services",
        "num_subscriptions",
        "num_timers",
    ]

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
        kinds = ("subscriptions", "guard_conditions", "timers", "clients", "services", "events")
        counts = ", ".join(str(getattr(self, f"num_{kind}")) for kind in kinds)
        return f"<{self.__class__.__name__}({counts})>"


class WaitSet:
    """The entities that a waitable waits for, and which of them are ready."""

    def __init__(self) -> None:
        self._entities: dict[str, list[Entity]] = {
            "guard_condition": [],
            "subscription": [],
            "timer": [],
            "event": [],
        }
        self._ready: set[Entity] = set()

    def add_guard_condition(self, guard_condition: GuardCondition) -> int:
        """Also wait for a guard condition; return its index for :meth:`is_ready`."""
        return self._add("guard_condition", guard_condition)

    def add_subscription(self, subscription: Subscription) -> int:
        """Also wait for a subscription; return its index for :meth:`is_ready`."""
        return self._add("subscription", subscription)

    def add_timer(self, timer: Timer) -> int:
        """Also wait for a timer; return its index for :meth:`is_ready`."""
        return self._add("timer", timer)

    def add_event(self, event: Entity) -> int:
        """Also wait for an event of the middleware; return its index for :meth:`is_ready`."""
        return self._add("event", event)

    def _add(self, entity_type: str, entity: Entity) -> int:
        self._entities[entity_type].append(entity)
        return len(self._entities[entity_type]) - 1

    def is_ready(self, entity_type: str, index: int) -> bool:
        """Return True if an entity is ready.

        Args:
            entity_type: ``guard_condition``, ``subscription``, ``timer`` or ``event``.
            index: What :meth:`add_guard_condition` and its like returned.
        """
        return self._entities[entity_type][index] in self._ready

    def mark_ready(self, entity: Entity) -> None:
        """Mark this entity, and no other, as ready."""
        self._ready = {entity}

    def entities(self) -> list[Entity]:
        """Return all entities."""
        return [entity for group in self._entities.values() for entity in group]


class Waitable(Entity):
    """Something an executor serves that consists of several entities.

    The executor serves the parts; to the outside they are one: they come and go together, and run
    before the other entities of a cycle. A program's own waitable says in :meth:`add_to_wait_set`
    what it waits for; then :meth:`is_ready`, :meth:`take_data` and :meth:`execute` are called in
    this order. Its parts are entities that it made itself (``GuardCondition(None, None)``), not
    entities that a node serves already.
    """

    _ORDER = -1

    def __init__(self, callback_group: CallbackGroup) -> None:
        super().__init__(callback_group)
        self._parts: list[Entity] = []
        self._wait_set: WaitSet | None = None

    def is_ready(self, wait_set: WaitSet) -> bool:
        """Return True if there is something to execute."""
        raise NotImplementedError

    def take_data(self) -> Any:
        """Take what made it ready; :meth:`execute` gets it."""
        raise NotImplementedError

    async def execute(self, taken_data: Any) -> Any:
        """Run; may also be an ordinary function."""
        raise NotImplementedError

    def get_num_entities(self) -> NumberOfEntities:
        """Return the numbers of entities to wait for."""
        raise NotImplementedError

    def add_to_wait_set(self, wait_set: WaitSet) -> None:
        """Add to ``wait_set`` what it waits for.

        The waitables of this package have fixed parts instead.
        """

    def _work_of(self, part: Entity) -> Work | None:
        """Return the work to run when a part is ready."""
        wait_set = self._wait_set
        if wait_set is None:
            return None  # it was never attached
        # A subscription keeps its message for the program's `take_data`.
        advanced = None if isinstance(part, Subscription) else part._take()
        if advanced is None and isinstance(part, Timer):
            return None  # cancelled, or its clock went back
        wait_set.mark_ready(part)
        return (self.execute, (self.take_data(),)) if self.is_ready(wait_set) else None

    def add_future(self, future: Future) -> None:
        """Run the done-callbacks of ``future`` on the executor that serves this waitable."""
        future._set_executor(self._serving_host())

    def remove_future(self, future: Future) -> None:
        """Undo :meth:`add_future`: the done-callbacks run in the thread that finishes it."""
        future._set_executor(None)

    def _attach(self, host: EntityHost) -> None:
        # Once: a waitable that moves to another executor keeps its parts.
        if self._wait_set is None:
            self._wait_set = WaitSet()
            self.add_to_wait_set(self._wait_set)
            for part in self._wait_set.entities():
                part._owner = self
                part.callback_group = self.callback_group
                self._parts.append(part)
        for part in self._parts:
            part._waitable = self
            host.adopt(part, self._membership)

    def _detach(self, host: EntityHost) -> None:
        for part in self._parts:
            host.release(part)

    def _pause(self, host: EntityHost) -> None:
        """Nothing: the executor pauses the parts."""

    def _resume(self, host: EntityHost) -> None:
        """Nothing: the executor resumes the parts."""

    def _close(self) -> None:
        for part in self._parts:
            part.destroy()
