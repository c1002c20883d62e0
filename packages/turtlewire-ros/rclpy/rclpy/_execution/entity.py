"""The entities of an executor: subscriptions, timers, services, clients and others.

Programs derive from some of these classes. Therefore all names that ROS 2 does not define begin
with an underscore, although the scheduler uses them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from rclpy._execution.handle import Handle
from rclpy._rclpy_pybind11 import InvalidHandle

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from rclpy.callback_groups import CallbackGroup
    from rclpy.task import Future, Task
    from turtlewire.wake_up import WakeUp

    from .membership import Membership
    from .wait import ExecutorWait

#: A callback and its arguments; the callback may be, or return, a coroutine.
Work = tuple["Callable[..., Any]", "tuple[Any, ...]"]


def _nothing() -> None:
    """Do nothing: there is no callback."""


#: The work after a message that another thread has handled already.
HANDLED: Work = (_nothing, ())


class EntityHost(Protocol):
    """The part of an executor that entities and blocking callbacks use: its `Scheduler`.

    Attributes:
        wait: Where entities report that they are ready.
        is_shutdown: Whether the executor was shut down.
        blocked: Set when the executor is shut down.
    """

    wait: ExecutorWait[Entity]
    is_shutdown: bool
    blocked: set[WakeUp]

    def adopt(self, entity: Entity, membership: Membership | None = None) -> None: ...

    def release(self, entity: Entity) -> None: ...

    def park(self, membership: Membership) -> None: ...

    def take_back(self, membership: Membership) -> None: ...

    def end_membership(self, membership: Membership) -> None: ...

    def create_task(self, callback: Callable[..., Any], *args: Any) -> Task[Any]: ...

    def wake(self) -> None: ...

    def is_spun(self) -> bool: ...

    def is_spun_by_this_thread(self) -> bool: ...

    def serving_responses(self, future: Future[Any]) -> AbstractContextManager[None]: ...

    def holds_up(self, service: str) -> bool: ...

    def next(
        self, timeout_ns: int | None, condition: Callable[[], bool] | None = None
    ) -> tuple[Entity | Task[Any], Work | None]: ...

    def execute(self, source: Entity | Task[Any], work: Work | None) -> None: ...


class Entity:
    """Base of all entities.

    An entity is *attached* to at most one executor, that of its node. When it is ready, the
    executor claims its callback group, calls :meth:`_take` and runs what comes back. An entity
    whose group is busy is *paused*: it must not report itself ready again before it is *resumed*,
    or the executor would spin.

    Attributes:
        callback_group: Says which callbacks may run at the same time.
        _membership: The entities of its node in an executor; None while none serves it.
        _rank: Its place in a cycle of the executor: number of the node, kind, number of the entity.
        _destroyed: Whether :meth:`destroy` was called.
        _on_destroy: Called with the entity after it was destroyed.
        _owner: The waitable of a program that decides about its work.
        _waitable: The waitable that it is part of.
    """

    #: Place in the order of one node's entities within a cycle of the executor (waitables of all
    #: nodes come first).
    _ORDER = 0
    #: Whether its work has to respect the callback group.
    _GATED = True

    callback_group: CallbackGroup

    def __init__(self, callback_group: CallbackGroup | None) -> None:
        self._membership: Membership | None = None
        self._rank: tuple[int, int, int] = (0, 0, 0)
        self._destroyed = False
        self._on_destroy: Callable[[Any], None] | None = None
        self._owner: _Owner | None = None
        self._waitable: Entity | None = None
        if callback_group is not None:
            self._enter(callback_group)

    def _enter(self, callback_group: CallbackGroup) -> None:
        self.callback_group = callback_group
        callback_group.add_entity(self)

    def _join(self, membership: Membership, number: int) -> bool:
        """Become a member; False if an executor serves it already, or it was destroyed."""
        # An executor that was dropped without a shutdown serves nothing.
        if self._serving_host() is not None or self._destroyed:
            return False
        # The parts of a waitable, which belong to no node, come in the order that it gives them.
        if self._waitable is not None or membership.node_index < 0:
            self._rank = (-1, 0, number)
        else:
            self._rank = (membership.node_index, self._ORDER, number)
        self._membership = membership
        return True

    def _leave(self, host: EntityHost) -> None:
        """Belong to no executor, and report to ``host`` no more."""
        self._membership = None
        self._detach(host)

    def _serving_host(self) -> EntityHost | None:
        """Return the executor that serves it."""
        membership = self._membership  # one look: another thread may detach it at any moment
        return None if membership is None or not membership.is_active else membership.host()

    def _host(self) -> EntityHost | None:
        """Return the executor that serves it, or has parked its node."""
        membership = self._membership
        return None if membership is None else membership.host()

    @property
    def handle(self) -> Any:
        """The entity itself, for ``with`` statements such as those around ROS 2's C handles."""
        self._check_usable()
        return self

    def __enter__(self) -> Any:
        self._check_usable()
        return self

    def __exit__(self, t: object, v: object, tb: object) -> None:
        """Nothing to release."""

    def _check_usable(self) -> None:
        if self._destroyed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")

    def destroy(self) -> None:
        """Take it out of its executor and close it; further use raises ``InvalidHandle``.

        Idempotent.
        """
        if self._destroyed:
            return
        # First: from now on no executor adopts the entity, and attaching it may fail silently.
        self._destroyed = True
        host = self._host()
        if host is not None:
            host.release(self)
        # After the release: a wait set must not hold a closed endpoint.
        self._close()
        if self._on_destroy is not None:
            self._on_destroy(self)

    def _close(self) -> None:
        """Release the entity's objects of the middleware."""

    def _attach(self, host: EntityHost) -> None:
        """Start to report readiness to ``host``."""
        raise NotImplementedError

    def _detach(self, host: EntityHost) -> None:
        """Stop reporting."""
        raise NotImplementedError

    def _pause(self, host: EntityHost) -> None:
        """Stop reporting for a while."""
        self._detach(host)

    def _resume(self, host: EntityHost) -> None:
        """Report again, at once if it is ready."""
        self._attach(host)

    def _take(self) -> Work | None:
        """Take what made it ready; None if there was nothing after all."""
        raise NotImplementedError

    def _serves(self, service: str) -> bool:  # noqa: ARG002 - most entities serve none
        """Return True if it answers requests of this service."""
        return False

    def _awaits(self, service: str) -> bool:  # noqa: ARG002 - most entities call none
        """Return True if it has sent a request to this service that is not answered yet."""
        return False


class ClosingEntity(Entity):
    """An entity that a ``with`` block destroys at its end."""

    @property
    def handle(self) -> Handle:
        """A stand-in for ROS 2's C object; a ``with`` block of it closes nothing."""
        self._check_usable()
        return Handle(self)

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        self.destroy()


class _Owner(Protocol):
    """The owner of an entity: a node or a waitable."""

    def _work_of(self, part: Entity) -> Work | None: ...
