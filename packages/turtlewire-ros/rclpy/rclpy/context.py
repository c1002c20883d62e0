"""Contexts: one participation in a ROS domain, from ``init`` to ``shutdown``."""

from __future__ import annotations

import atexit
import sys
import threading
import time
import warnings
import weakref
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from turtlewire.distro import KILTED, since
from turtlewire.wake_up import WakeUp

from . import signals
from ._rclpy_pybind11 import RCLError
from .exceptions import NotInitializedException

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.wire import base

    from .impl.arguments import Arguments

#: The number of open contexts that have initialized logging.
g_logging_ref_count = 0

_ALREADY_SHUT_DOWN = "failed to shutdown: rcl_shutdown already called on the given context"


class _Scheduler(Protocol):
    """The part of an executor that a context uses."""

    def holds_up(self, service: str) -> bool: ...


class _Wait(Protocol):
    """A wait that the shutdown of a context ends."""

    def set(self) -> None: ...


class _Node(Protocol):
    """The part of a node that a context uses."""

    def destroy_node(self) -> None: ...


class Context:
    """Participates in a domain between :meth:`init` and :meth:`shutdown`.

    Thread-safe. ``with Context() as context:`` calls :meth:`init`, and shuts down at the end.

    A signal shuts a context down as well, but leaves the middleware open until :meth:`shutdown` or
    the end of the process, so that the program can still say goodbye; the one :meth:`shutdown`
    that follows a signal is not an error.
    """

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._wire: base.Context | None = None
        self._arguments: Arguments | None = None
        self._valid = False
        self._initialized_logging = False
        self.ended_by_signal = False
        self.signal: int | None = None
        self.ended_at_exit = False
        self._callbacks: list[Callable[[], Callable[[], None] | None]] = []
        self.waits: set[_Wait] = set()
        self._schedulers: weakref.WeakSet[_Scheduler] = weakref.WeakSet()  # of its executors
        self._nodes: weakref.WeakSet[_Node] = weakref.WeakSet()

    def init(
        self,
        args: list[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
    ) -> None:
        """Join a domain.

        Args:
            args: Command line whose ``--ros-args`` apply to all nodes; None uses ``sys.argv``.
            initialize_logging: Whether log levels of the command line take effect and the log file
                is opened.
            domain_id: None uses ``ROS_DOMAIN_ID``, else 0.

        Raises:
            RuntimeError: The context was initialized before, or the domain id is negative.
            UnknownROSArgsError, RCLInvalidROSArgsError: The command line is wrong.
            UnicodeEncodeError: The command line is not UTF-8.
            WireError: The middleware is missing, or its settings are wrong.
        """
        from .impl.arguments import Arguments

        with self._lock:
            if domain_id is not None and domain_id < 0:
                raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
            if self._wire is not None:
                raise RuntimeError("Context.init() must only be called once")
            self._arguments = Arguments.parse_global(sys.argv if args is None else args)
            self._wire = self._joined(domain_id, self._arguments, initialize_logging)
            self._valid = True
            _open_contexts.add(self)
            atexit.unregister(_close_open_contexts)
            atexit.register(_close_open_contexts)  # again: must run before the middleware ends
            signals.listeners.add(self)
            self._initialized_logging = initialize_logging

    def _joined(
        self, domain_id: int | None, arguments: Arguments, initialize_logging: bool
    ) -> base.Context:
        """Open the middleware, and initialize logging if asked to; both or neither."""
        from turtlewire.errors import WireError
        from turtlewire.wire import open_context

        with ExitStack() as if_it_fails:
            try:
                wire = open_context(domain_id, enclave=arguments.enclave)
            except WireError as error:
                # The settings are at fault: the excepthook shows one line instead of a traceback.
                error.is_of_environment = True
                raise
            if_it_fails.callback(wire.close)
            # Discovery begins here, so that the first query of the graph finds other nodes.
            _ = wire.graph
            if initialize_logging:
                is_first = _count_logging(1) == 1
                if_it_fails.callback(_count_logging, -1)
                if is_first:  # as in ROS 2, the first context's command line decides
                    arguments.configure_logging()
            if_it_fails.pop_all()
        return wire

    def track_node(self, node: _Node) -> None:
        """Have a shutdown destroy a node, as in Kilted and later; held weakly."""
        self._nodes.add(node)

    def untrack_node(self, node: _Node) -> None:
        """Leave a node alone at a shutdown."""
        self._nodes.discard(node)

    def ok(self) -> bool:
        """Return True if it is initialized and has not been shut down."""
        return self._valid

    def is_open(self) -> bool:
        """Return True if endpoints work.

        After a signal they still do, until the program calls :meth:`shutdown`: it may send its last
        messages.
        """
        return self._valid or self.ended_by_signal

    def get_domain_id(self) -> int:
        """Return the domain it is in; RuntimeError before :meth:`init`."""
        if self._wire is None:
            raise RuntimeError("Context must be initialized before it can have a domain id")
        return self.wire.domain_id

    @property
    def wire(self) -> base.Context:
        """The middleware's side of it.

        Raises:
            NotInitializedException: Before :meth:`init`.
        """
        if self._wire is None:
            raise NotInitializedException("context is not initialized")
        return self._wire

    @property
    def arguments(self) -> Arguments:
        """Arguments of the command line.

        Raises:
            NotInitializedException: Before :meth:`init`.
        """
        if self._arguments is None:
            raise NotInitializedException("context is not initialized")
        return self._arguments

    @property
    def handle(self) -> base.Context | None:
        """The middleware's context, None before :meth:`init`."""
        return self._wire

    def shutdown(self) -> None:
        """Leave the domain: run the shutdown callbacks, end all waits, close all endpoints.

        Raises:
            RuntimeError: The context was never initialized.
            RCLError: The context was already shut down by a call.
            Exception: A shutdown callback raised it; the others were called, and it is shut down.
        """
        with self._lock:
            if self._wire is None:
                raise RuntimeError("Context must be initialized before it can be shutdown")
            if not self._valid and not self.ended_by_signal:
                raise RCLError(_ALREADY_SHUT_DOWN)
        self.try_shutdown()

    def try_shutdown(self) -> None:
        """Shut down, unless the context is not initialized or was shut down before."""
        with self._lock:
            if not self._valid and not self.ended_by_signal:
                return
            end = self._invalidate(by_signal=False)
        # Without the lock, because shutdown callbacks use the context; before the middleware is
        # closed, because they may send messages.
        nodes = list(self._nodes) if since(KILTED) else []
        _call_all([*(node.destroy_node for node in nodes), end, self._close])

    def _close(self) -> None:
        """Close logging and the middleware."""
        _open_contexts.discard(self)
        # After a signal, several threads may get here.
        with self._lock:
            counted, self._initialized_logging = self._initialized_logging, False
        if counted:
            _count_logging(-1)
        if self._wire is not None:
            self._wire.close()

    def on_signal(self, signum: int) -> None:
        """Shut down because of a signal; the middleware stays open for the program's last words."""
        with self._lock:
            if not self._valid:
                return
            self.signal = signum
            end = self._invalidate(by_signal=True)
        end()

    def wake_waits(self) -> None:
        """Wake all threads that wait for the graph or for a response, to check again."""
        with self._lock:
            waits = list(self.waits)
        for wait in waits:
            wait.set()

    def _invalidate(self, *, by_signal: bool) -> Callable[[], None]:
        """Mark it as shut down.

        Returns:
            A function that wakes all waiting threads; call it without the lock.
        """
        self._valid = False
        self.ended_by_signal = by_signal
        callbacks, self._callbacks = self._callbacks, []
        waits = list(self.waits)

        def tell() -> None:
            for wait in waits:
                wait.set()
            _call_all([partial(_call_referent, reference) for reference in callbacks])

        return tell

    def wait_for_graph(self, predicate: Callable[[], bool], timeout_ns: int | None) -> bool:
        """Block until ``predicate()`` is true, looking again after each change of the graph.

        A shutdown ends the wait.

        Returns:
            The last value of the predicate.
        """
        deadline = None if timeout_ns is None else time.monotonic() + timeout_ns / 1e9
        changed = WakeUp()
        # Before the first look: a change between the look and the wait must not be missed.
        with self.waking_at_changes(changed):
            while True:
                # Before the deadline is checked: with a timeout of 0, there is still one look.
                if predicate():
                    return True
                remaining = None if deadline is None else deadline - time.monotonic()
                if not self._valid or (remaining is not None and remaining <= 0):
                    return False
                changed.wait(remaining)

    @contextmanager
    def waking_at_changes(self, wait: _Wait) -> Iterator[None]:
        """Within the block, call ``wait.set()`` at each change of the graph, and at a shutdown."""
        with self._lock:
            self.waits.add(wait)
        remove_listener = self.wire.graph.add_listener(wait.set)
        try:
            yield
        finally:
            remove_listener()
            with self._lock:
                self.waits.discard(wait)

    def on_shutdown(self, callback: Callable[[], None]) -> None:
        """Call ``callback()`` once when it shuts down; at once if it is shut down already.

        Methods are held weakly.

        After a signal the callback runs on the thread that watches signals. What it raises there is
        reported by :func:`threading.excepthook`; otherwise :meth:`shutdown` raises it at its end.
        """
        if not callable(callback):
            # ROS 2's error, with its forgotten `format`.
            raise TypeError("callback should be a callable, got {}", type(callback))
        with self._lock:
            if self._valid:
                # Executors and sleeps end: references to finished ones must not accumulate.
                self._callbacks = [
                    reference for reference in self._callbacks if reference() is not None
                ]
                self._callbacks.append(_reference(callback))
                return
        callback()

    def destroy(self) -> None:
        """Shut it down unless that has happened, and close the middleware. Idempotent."""
        self.try_shutdown()

    def __enter__(self) -> Self:
        if not self.ok():
            if since(KILTED):
                warnings.warn(
                    "init() must be called on a Context before using it in a Python context "
                    "manager. Calling init() with no arguments, this usage is deprecated",
                    stacklevel=2,
                )
            self.init()
        return self

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        self.try_shutdown()


def _reference(callback: Callable[[], None]) -> Callable[[], Callable[[], None] | None]:
    """Return a weak reference to a method, a strong one to a function.

    So a context keeps no object alive.
    """
    if hasattr(callback, "__self__") and hasattr(callback, "__func__"):
        return weakref.WeakMethod(callback)
    return lambda: callback


def _call_referent(reference: Callable[[], Callable[[], None] | None]) -> None:
    """Call the method or function if it still exists."""
    callback = reference()
    if callback is not None:
        callback()


def _call_all(calls: list[Callable[[], object]]) -> None:
    """Call each in order, also after one that raises; the last exception propagates."""
    with ExitStack() as stack:
        for call in reversed(calls):
            stack.callback(call)


_open_contexts: set[Any] = set()
_logging_lock = threading.Lock()


def _count_logging(change: int) -> int:
    global g_logging_ref_count  # noqa: PLW0603 - ROS 2's variable
    with _logging_lock:
        g_logging_ref_count += change
        return g_logging_ref_count


def _close_open_contexts() -> None:
    """Leave the domain at the end of the process, so that peers need not wait for our lease."""
    contexts = list(_open_contexts)
    for context in contexts:
        context.ended_at_exit = True
    _call_all([context.try_shutdown for context in contexts])
