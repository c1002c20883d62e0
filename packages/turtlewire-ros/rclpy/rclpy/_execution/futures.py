"""Private functions of executors, clients and waitables for futures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rclpy.task import Future

    from .entity import EntityHost


def call_when_done(future: Future[Any], call: Callable[[], object]) -> None:
    """Call ``call()`` in the thread that finishes the future; at once if it is done.

    Unlike a done-callback, it never goes through an executor: it must be short and not raise.
    """
    future._add_waiter(call)


@contextmanager
def calling_when_done(future: Future[Any], call: Callable[[], object]) -> Iterator[None]:
    """Within the block, have :func:`call_when_done` call ``call()``."""
    future._add_waiter(call)
    try:
        yield
    finally:
        future._remove_waiter(call)


def run_callbacks_on(host: EntityHost | None, future: Future[Any]) -> None:
    """Run the done-callbacks of a future on an executor; None: in the finishing thread."""
    future._set_executor(host)
