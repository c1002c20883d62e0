"""SIGINT and SIGTERM: they end every wait of the middleware and shut all contexts down.

Python runs its signal handlers in the main thread, between two bytecodes: a thread that blocks in
the middleware would never get there. So the interpreter's C handler writes the signal's number into
a pipe (:func:`signal.set_wakeup_fd`), and one owned thread reads the pipe and shuts the contexts
down, which wakes their wait sets. The main thread leaves its wait and Python raises
``KeyboardInterrupt`` there, for SIGINT. SIGTERM raises nothing by itself: ``spin`` raises
``ExternalShutdownException``.
"""

from __future__ import annotations

import atexit
import os
import signal
import sys
import threading
import time
import weakref
from contextlib import suppress
from enum import IntEnum
from types import FrameType
from typing import Any, Protocol

from turtlewire.guarded import call_guarded
from turtlewire.platforms import in_browser

from ._execution.asyncio_loop import interrupted_loop, running_loop
from .impl import excepthooks
from .impl.reexports import reexports

__all__ = [
    "REPEATED_INTERRUPT_S",
    "SignalHandlerGuardCondition",  # noqa: F822 - `__getattr__` hands it on
    "SignalHandlerOptions",
    "SignalListener",
    "get_current_signal_handlers_options",
    "install_signal_handlers",
    "listeners",
    "rearm",
    "rearm_after_loops",
    "uninstall_signal_handlers",
]

__getattr__ = reexports(__name__, {"rclpy.guard_condition": ("SignalHandlerGuardCondition",)})

#: A terminal and `ros2 launch` both send SIGINT for one Ctrl-C: within this time the second one is
#: not a new request of the user.
REPEATED_INTERRUPT_S = 1.0

_STOP = 0
_FROM_HANDLER = 0x80


class SignalHandlerOptions(IntEnum):
    """The signals that shut the contexts down."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


class SignalListener(Protocol):
    """A receiver of signals: a context."""

    def on_signal(self, signum: int) -> None:
        """Shut down.

        Called on the thread of the signals, more than once when a signal comes again.
        """


#: Called at each signal; a context adds itself.
listeners: weakref.WeakSet[SignalListener] = weakref.WeakSet()


class _Watcher:
    """Owns the handlers, the pipe and the thread between them."""

    def __init__(self, signals: list[signal.Signals]) -> None:
        self._previous: dict[int, Any] = {}
        self._interrupted_at = self._terminated_at = -REPEATED_INTERRUPT_S
        self._is_deferred = False
        self._read_fd, self._write_fd = os.pipe()
        # The C handler must not block on a full pipe, which holds enough wake-ups anyway.
        if sys.platform != "win32":
            os.set_blocking(self._write_fd, False)
        self._previous_wakeup_fd = signal.set_wakeup_fd(self._write_fd, warn_on_full_buffer=False)
        self._thread = threading.Thread(target=self._run, name="rclpy-signals", daemon=True)
        self._thread.start()
        for signum in signals:
            self._previous[signum] = signal.signal(signum, self._handle)

    def close(self) -> None:
        """Put the former handlers back, end the thread and join it."""
        for signum, previous in self._previous.items():
            if signal.getsignal(signum) == self._handle and not self._is_needed_for(signum):
                # None means a handler that was not installed from Python.
                signal.signal(signum, previous if previous is not None else signal.SIG_DFL)
        current_fd = signal.set_wakeup_fd(-1)
        owner_fd = self._previous_wakeup_fd if current_fd == self._write_fd else current_fd
        with suppress(OSError, ValueError):  # the owner closed it, or it is another file now
            signal.set_wakeup_fd(owner_fd)
        write_fd, self._write_fd = self._write_fd, -1
        os.write(write_fd, bytes([_STOP]))
        self._thread.join()
        os.close(write_fd)
        os.close(self._read_fd)

    def _run(self) -> None:
        while True:
            for byte in os.read(self._read_fd, 64):
                if byte == _STOP:
                    return
                # The descriptor's previous owner also gets the bytes of the C handler.
                if not byte & _FROM_HANDLER:
                    self._forward(byte)
                if byte & ~_FROM_HANDLER in self._previous:
                    excepthooks.note_signal()
                    for listener in list(listeners):
                        call_guarded(listener.on_signal, byte & ~_FROM_HANDLER)

    def _forward(self, signum: int) -> None:
        """Pass a signal on to the descriptor's previous owner, for example asyncio."""
        if self._previous_wakeup_fd >= 0:
            with suppress(OSError):  # the owner closed it
                os.write(self._previous_wakeup_fd, bytes([signum]))

    def rearm(self) -> None:
        """Take the descriptor again if another owner has it; its bytes are passed on.

        An asyncio loop with signal handlers takes it. At its end the loop sets none, and resets the
        handlers; one that the program has set stays.
        """
        former_fd = signal.set_wakeup_fd(self._write_fd, warn_on_full_buffer=False)
        if former_fd == self._write_fd:
            return
        self._previous_wakeup_fd = former_fd
        for signum in self._previous:
            if signal.getsignal(signum) in {signal.SIG_DFL, signal.default_int_handler}:
                signal.signal(signum, self._handle)

    def _is_needed_for(self, signum: int) -> bool:
        """Return True if a signal after the shutdown belongs to the request that caused it.

        After SIGTERM, SIGINT may follow at once: from `ros2 launch` below `timeout`, for example.
        """
        if _is_fresh(self._interrupted_at):
            return True
        return signum == signal.SIGINT and _is_fresh(self._terminated_at)

    def _handle(self, signum: int, frame: FrameType | None) -> None:
        """Runs in the main thread, after the C handler has written to the pipe."""
        excepthooks.note_signal()  # because the thread may be slower
        if self._write_fd >= 0:  # the descriptor of the C handler may be another library's
            os.write(self._write_fd, bytes([signum | _FROM_HANDLER]))
        if signum == signal.SIGINT:
            is_shut_down = self._write_fd < 0
            # Then this signal repeats the KeyboardInterrupt that Python dropped.
            if excepthooks.take_dropped():
                self._interrupted_at = -REPEATED_INTERRUPT_S
            if _is_fresh(self._interrupted_at) or (is_shut_down and _is_fresh(self._terminated_at)):
                return
            self._interrupted_at = time.monotonic()
        else:
            self._terminated_at = time.monotonic()
        _note_stop()
        previous = self._previous[signum]
        loop = interrupted_loop(frame)
        if previous is signal.default_int_handler and loop is not None and not self._is_deferred:
            # In asyncio's own code KeyboardInterrupt could lose a callback that is about to be
            # called, and a task would wait for it without end. Raised by a callback, it loses none.
            # Beside asynchronous nodes, it must not come out of one of their callbacks.
            self._is_deferred = True
            loop.call_soon_threadsafe(self._interrupt, signum, frame)
        elif callable(previous):
            previous(signum, frame)

    def _interrupt(self, signum: int, frame: FrameType | None) -> None:
        self._is_deferred = False
        signal.default_int_handler(signum, frame)

    def forget(self) -> None:
        """Leave the pipe to the parent, in a forked child that has no thread to read it."""
        signal.set_wakeup_fd(-1)
        self._write_fd = -1
        for signum, previous in self._previous.items():
            signal.signal(signum, previous if previous is not None else signal.SIG_DFL)


def _is_fresh(moment: float) -> bool:
    return time.monotonic() - moment < REPEATED_INTERRUPT_S


_lock = threading.Lock()
_watcher: _Watcher | None = None
_options = SignalHandlerOptions.NO
_stopped = False


def _note_stop() -> None:
    global _stopped  # noqa: PLW0603 - as of the handlers, there is one in the process
    _stopped = True


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return the signals that are handled now."""
    return _options


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Handle the signals of ``options``; nothing happens when handlers are installed already.

    Python allows this in the main thread only: elsewhere nothing is installed, and signals stay the
    main program's business. In a browser tab no signal comes, and no thread could wait for one.
    """
    global _watcher, _options  # noqa: PLW0603 - signal handlers belong to the process
    with _lock:
        if (
            _watcher is not None
            or options == SignalHandlerOptions.NO
            or in_browser()
            or threading.current_thread() is not threading.main_thread()
        ):
            return
        signals = [
            signum
            for signum in (signal.SIGINT, signal.SIGTERM)
            if options & SignalHandlerOptions[signum.name]
        ]
        excepthooks.install()
        _watcher = _Watcher(signals)
        _options = SignalHandlerOptions(options)


def rearm() -> None:
    """Restore the handling of signals that asyncio has replaced.

    Nothing happens in other threads, and without installed handlers.
    """
    if _watcher is not None and threading.current_thread() is threading.main_thread():
        _watcher.rearm()


def rearm_after_loops() -> None:
    """Restore the handling as `rearm` does, unless an asyncio loop runs in this thread."""
    if running_loop() is None:
        rearm()


def uninstall_signal_handlers() -> None:
    """Put the former handlers back; nothing happens when none are installed."""
    global _watcher, _options
    with _lock:
        if _watcher is None or threading.current_thread() is not threading.main_thread():
            return
        watcher, _watcher, _options = _watcher, None, SignalHandlerOptions.NO
    # Without the lock: this joins a thread that runs shutdown callbacks.
    watcher.close()


#: The signal mask of a thread that forks; several may at once.
_forking = threading.local()


def _before_fork() -> None:
    """Hold signals back.

    One to the child must not come through the pipe that it has in common with its parent.
    """
    if sys.platform == "win32":
        return
    _forking.mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})


def _after_fork_in_parent() -> None:
    if sys.platform == "win32":
        return
    signal.pthread_sigmask(signal.SIG_SETMASK, _forking.mask)


def _after_fork_in_child() -> None:
    global _watcher, _options
    if sys.platform == "win32":
        return
    watcher, _watcher, _options = _watcher, None, SignalHandlerOptions.NO
    if watcher is not None:
        watcher.forget()
    signal.pthread_sigmask(signal.SIG_SETMASK, _forking.mask)


def _end() -> None:
    """Restore the handlers at the end of the process, but ignore SIGINT after a stop."""
    uninstall_signal_handlers()
    # Python's own end restores the default of SIGINT: the second signal of the same Ctrl-C, or one
    # after SIGTERM, would kill a process that ends well.
    if _stopped:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


atexit.register(_end)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=_before_fork,
        after_in_parent=_after_fork_in_parent,
        after_in_child=_after_fork_in_child,
    )
