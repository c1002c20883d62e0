"""Events of messages that another thread handles; they still end a ``spin_once``."""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Protocol

from rclpy._execution.entity import HANDLED, Entity, EntityHost, Work


class Arrivals(Protocol):
    """A handler of messages, such as :class:`turtlewire.tf.listener.TransformListener`."""

    def on_message(self, call: Callable[[], None]) -> None:
        """Call ``call()`` after messages; native code only after :meth:`expect_message`."""
        ...

    def expect_message(self, waker: tuple[int, int] | None = None) -> bool:
        """Return True if a message came since :meth:`take_arrivals`; else report the next.

        With a waker, native code may use it instead of the call.
        """
        ...

    def take_arrivals(self) -> bool:
        """Return True if a message came since the last call."""
        ...


class BackgroundEvents(Entity):
    """Lets messages that the wire's own threads handle count as events of an executor.

    In ROS 2 a TransformListener's subscriptions are served by the executor, so programs wait for
    transforms with ``spin_once`` in a loop. Here the executor asks for the next message while a
    ``spin_once`` waits, and only then: ``spin`` is not woken by messages that need no callback.
    """

    # Last in a cycle, and without a callback group: there is no callback to run.
    _ORDER = 5
    _GATED = False

    def __init__(self, arrivals: Arrivals) -> None:
        super().__init__(None)
        self._arrivals = arrivals
        self._expecting = False
        report = weakref.WeakMethod(self._report)  # what is called later keeps no node alive

        def report_if_alive() -> None:
            method = report()
            if method is not None:
                method()

        arrivals.on_message(report_if_alive)

    def expect(self, waker: tuple[int, int] | None) -> None:
        """Report the next message to the executor, at once if one came already.

        Args:
            waker: Ends the executor's wait from native code; then the executor has to ask.
        """
        self._expecting = True
        if self._arrivals.expect_message(waker):
            self._report()

    def _report(self) -> None:
        host = self._serving_host()
        if host is not None and self._expecting:
            self._expecting = False
            host.wait.notify(self)

    def _attach(self, host: EntityHost) -> None:
        host.wait.background.add(self)

    def _detach(self, host: EntityHost) -> None:
        host.wait.background.discard(self)

    def _take(self) -> Work | None:
        return HANDLED if self._arrivals.take_arrivals() else None
