"""Guard conditions: callbacks that any thread can trigger."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from . import signals
from ._execution.entity import Entity, EntityHost, Work
from ._rclpy_pybind11 import InvalidHandle

if TYPE_CHECKING:
    from .callback_groups import CallbackGroup
    from .context import Context


class GuardCondition(Entity):
    """Runs its callback on the executor after :meth:`trigger`.

    Several triggers before it runs count as one.
    """

    _ORDER = 2

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        context: Context | None = None,
    ) -> None:
        from .utilities import get_default_context

        super().__init__(callback_group)
        self.callback = callback
        self._context = get_default_context() if context is None else context
        self._triggered = False

    def trigger(self) -> None:
        """Trigger the callback. Safe from any thread."""
        self._check_usable()
        self._triggered = True
        host = self._serving_host()
        if host is not None:
            host.wait.notify(self)

    def _attach(self, host: EntityHost) -> None:
        if self._triggered:
            host.wait.notify(self)

    def _detach(self, host: EntityHost) -> None:
        """A trigger stays stored until an executor comes."""

    def _take(self) -> Work | None:
        if not self._triggered:
            return None
        self._triggered = False
        return None if self.callback is None else (self.callback, ())


class SignalHandlerGuardCondition(GuardCondition):
    """A guard condition that each handled signal triggers, until it is destroyed.

    Args:
        context: Its context; None uses the default.
    """

    def __init__(self, context: Context | None = None) -> None:
        super().__init__(None, None, context)
        signals.listeners.add(self)

    def on_signal(self, signum: int) -> None:  # noqa: ARG002 - each signal does the same
        """Trigger it. Called on the thread of the signals."""
        with suppress(InvalidHandle):  # another thread may destroy it at any moment
            self.trigger()

    def destroy(self) -> None:
        """Ignore further signals, and close it. Idempotent."""
        signals.listeners.discard(self)
        super().destroy()
