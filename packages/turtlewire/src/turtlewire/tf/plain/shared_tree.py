"""The tree with a lock, for many threads: lookups, waiting and change listeners."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import TYPE_CHECKING, TypeVar

from turtlewire.call_errors import explain_calls
from turtlewire.tf.plain import fork
from turtlewire.tf.plain.checks import nanoseconds
from turtlewire.tf.plain.failure import ERRORS, Failure
from turtlewire.tf.plain.status import LookupStatus
from turtlewire.tf.plain.tree import Tree
from turtlewire.wake_up import WakeUp

if TYPE_CHECKING:
    from turtlewire.errors import TransformException

_Answer = TypeVar("_Answer")
#: Their hints depend on the buffer.
_WITH_BUFFER = {
    LookupStatus.UNKNOWN_FRAME,
    LookupStatus.LOOP,
    LookupStatus.NO_DATA,
    LookupStatus.FUTURE,
    LookupStatus.PAST,
}


@explain_calls
class SharedTree:
    """A tree, the lock that guards it, and the listeners of its changes.

    Args:
        keep: How long samples are kept, in nanoseconds.
        max_frames: How many frames are taken; None: no limit.
    """

    # As in the compiled core, setting a misspelt attribute is an error.
    __slots__ = ("__weakref__", "_listeners", "_lock", "_tree", "_waits")

    def __init__(self, keep: int, max_frames: int | None = None) -> None:
        self._tree = Tree(keep, max_frames)
        # Not a `threading.Condition`, which a signal can leave locked; see `turtlewire.wake_up`.
        self._lock = threading.RLock()
        self._waits: set[WakeUp] = set()
        self._listeners: list[Callable[[], object]] = []
        fork.guard(self._lock)

    def on_change(self, call: Callable[[], object]) -> Callable[[], None]:
        """Call ``call()`` after data came in.

        The thread that brought the data calls it, without any lock.

        Returns:
            A function that ends the calls.
        """
        if not callable(call):
            given = type(call).__name__
            raise TypeError(f"call must be a function that takes no arguments, not {given}")
        self._listeners.append(call)
        return partial(self._remove_change_listener, call)

    def _remove_change_listener(self, listener: Callable[[], object]) -> None:
        self._listeners = [known for known in self._listeners if known is not listener]

    def _call_listeners(self) -> None:
        for listener in tuple(self._listeners):
            _call(listener)

    def _wake(self) -> None:
        """Make every waiting lookup check for pending signals now; without one it waits on."""
        with self._lock:
            self._end_waits()

    def _end_waits(self) -> None:
        """Have the waiting lookups ask again; called with the lock held."""
        for wait in self._waits:
            wait.set()

    def _raising(self, ask: Callable[[], _Answer], timeout_ns: int) -> _Answer:
        try:
            return self._waiting(ask, timeout_ns)
        except Failure as failure:
            raise self._error(failure) from None

    def _checked(self, ask: Callable[[], _Answer]) -> _Answer:
        """Ask; called with the lock held."""
        try:
            return ask()
        except Failure as failure:
            raise self._error(failure) from None

    def _error(self, failure: Failure) -> TransformException:
        error = ERRORS[failure.status](str(failure))
        for name, value in failure.details.items():
            setattr(error, name, value)
        if failure.status in _WITH_BUFFER:
            error._buffer = self  # type: ignore[attr-defined] # ERRORS says that it has one
        return error

    def _reason(self, ask: Callable[[], object], timeout_ns: int) -> str:
        try:
            self._waiting(ask, timeout_ns)
        except Failure as failure:
            return str(failure)
        return ""

    def _waiting(self, ask: Callable[[], _Answer], timeout_ns: int) -> _Answer:
        """Ask; after a Failure that more data can end, ask again when data comes in."""
        (timeout_ns,) = nanoseconds(timeout_ns=timeout_ns)
        if timeout_ns <= 0:
            with self._lock:
                return ask()
        deadline = time.monotonic_ns() + timeout_ns
        changed = WakeUp()
        try:
            while True:
                with self._lock:
                    try:
                        return ask()
                    except Failure as failure:
                        left = deadline - time.monotonic_ns()
                        if left <= 0 or failure.hopeless:
                            raise
                    self._waits.add(changed)
                changed.wait(left / 1e9)
        finally:
            with self._lock:
                self._waits.discard(changed)


def _call(listener: Callable[[], object]) -> None:
    try:
        listener()
    except Exception as error:  # noqa: BLE001 - not the fault of the caller, who brought data
        sys.unraisablehook(
            SimpleNamespace(
                exc_type=type(error),
                exc_value=error,
                exc_traceback=error.__traceback__,
                err_msg=None,
                object=listener,
            )
        )
