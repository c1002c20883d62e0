"""What an executor serves: subscriptions, timers, services, clients, guard conditions and waitables have this in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._rclpy_pybind11 import InvalidHandle

if TYPE_CHECKING:
    import weakref
    from collections.abc import Callable

    from .callback_groups import CallbackGroup
    from .executors import Executor
    from .waitable import Waitable

__all__ = ["Entity", "Work"]

#: A callback and its arguments; the callback may be, or return, a coroutine.
Work = tuple["Callable[..., Any]", "tuple[Any, ...]"]


class Entity:
    """Base of all entities.

    An entity is *attached* to at most one executor, that of its node. When it is ready, the
    executor claims its callback group, calls :meth:`_work` and runs the work that comes back. An
    entity whose group is busy is *paused*: it must not report itself ready again before it is
    *resumed*, or the executor would spin.

    Attributes:
        callback_group: Says which callbacks may run at the same time.
    """

    #: Place in the order of one node's entities within a cycle of the executor (waitables of all
    #: nodes come first).
    _ORDER = 0
    #: Whether its work has to respect the callback group.
    _GATED = True

    callback_group: CallbackGroup

    def __init__(self, callback_group: CallbackGroup | None) -> None:
        self._executor: weakref.ref[Executor] | None = None
        self._rank: tuple[int, int, int] = (0, 0, 0)
        self._destroyed = False
        self._on_destroy: Callable[[Entity], None] | None = None
        self._owner: Waitable | None = None
        if callback_group is not None:
            self.callback_group = callback_group
            callback_group.add_entity(self)

    def _serving_executor(self) -> Executor | None:
        reference = self._executor  # one look: another thread may detach it at any moment
        return None if reference is None else reference()

    @property
    def handle(self) -> Any:
        """The entity itself: there is no C handle behind it. Usable in a ``with`` statement, as ROS 2's handles are."""
        self._check_usable()
        return self

    def __enter__(self) -> Any:
        self._check_usable()
        return self

    def __exit__(self, *exception: object) -> None:
        """Nothing to release."""

    def _check_usable(self) -> None:
        if self._destroyed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")

    def destroy(self) -> None:
        """Take it out of its executor and close it; further use raises ``InvalidHandle``. Idempotent."""
        if self._destroyed:
            return
        self._destroyed = True
        executor = self._serving_executor()
        if executor is not None:
            executor._detach(self)
        self._close()
        if self._on_destroy is not None:
            self._on_destroy(self)

    def _close(self) -> None:
        """Release what it holds on the wire."""

    def _attach(self, executor: Executor) -> None:
        """Report readiness to ``executor`` from now on."""
        raise NotImplementedError

    def _detach(self, executor: Executor) -> None:
        """Stop reporting."""
        raise NotImplementedError

    def _pause(self, executor: Executor) -> None:
        """Stop reporting for a while."""
        self._detach(executor)

    def _resume(self, executor: Executor) -> None:
        """Report again, at once if it is ready."""
        self._attach(executor)

    def _work(self) -> Work | None:
        """What has to run now; the executor calls it."""
        return self._take() if self._owner is None else self._owner._work_of(self)

    def _take(self) -> Work | None:
        """Take what made it ready and return what has to run; None when there was nothing after all."""
        raise NotImplementedError
