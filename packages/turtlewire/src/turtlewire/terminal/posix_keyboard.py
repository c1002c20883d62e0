"""Keys of a terminal of POSIX, one by one as they are typed."""

from __future__ import annotations

import contextlib
import copy
import errno
import os
import select
import signal
import sys
import threading
from collections.abc import Iterator
from types import TracebackType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import Self

assert sys.platform != "win32"  # console_keyboard is for Windows

__all__ = ["ENDING_SIGNALS", "PosixKeyboard", "foreground_terminal", "signals_for_this_thread"]

#: Signals that end a program without an exception, and would leave the terminal without echo.
ENDING_SIGNALS = (signal.SIGHUP, signal.SIGQUIT)


class PosixKeyboard:
    """The terminal, in a mode that gives each byte as it is typed within a ``with`` block.

    It is put back into its own mode at the end of the block, and while Ctrl-Z stops the process.
    For the main thread, except for :meth:`read` and :meth:`stop`.

    Args:
        fd: The terminal's file descriptor.

    Raises:
        OSError: The file descriptor is not a terminal.
    """

    def __init__(self, fd: int) -> None:
        import termios

        self._fd = fd
        try:
            self._cooked = termios.tcgetattr(self._fd)
        except termios.error as error:
            raise OSError(*error.args) from error
        self._wake_read, self._wake_write = os.pipe()
        os.set_blocking(self._wake_write, False)  # the handler of signals in C must not block
        self._stopped = False

    def __enter__(self) -> Self:
        self._take()
        self._handlers = {
            number: signal.signal(number, handler)
            for number, handler in (
                (signal.SIGTSTP, self._suspend),
                (signal.SIGCONT, self._resume),
            )
        }
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for number, handler in self._handlers.items():
            signal.signal(number, handler)
        self._give_back()

    def _take(self) -> None:
        import termios

        raw = copy.deepcopy(self._cooked)
        raw[3] &= ~(termios.ICANON | termios.ECHO)
        raw[6][termios.VMIN], raw[6][termios.VTIME] = 1, 0
        self._set(raw)

    def _give_back(self) -> None:
        self._set(self._cooked)

    def _set(self, mode: list[Any]) -> None:
        import termios

        try:
            termios.tcsetattr(self._fd, termios.TCSANOW, mode)
        except termios.error as error:
            # In the background the attempt stops the process (SIGTTOU), and SIGCONT interrupts it.
            # Other errors mean that the terminal is gone.
            if error.args[0] == errno.EINTR:
                self._set(mode)

    def _suspend(self, *_: object) -> None:
        self._give_back()
        signal.raise_signal(signal.SIGSTOP)
        # The kernel may hand SIGCONT to another thread. This one would then wait for a key again
        # before the signal's handler can run here.
        self._resume()

    def _resume(self, *_: object) -> None:
        self._take()
        self._wake()

    def read(self) -> bytes:
        """Wait for the next byte; empty when the terminal is gone or :meth:`stop` was called."""
        while (typed := self._next(1, None)) is None:
            pass
        return typed

    def read_within(self, seconds: float) -> bytes | None:
        """Return what is typed within a time.

        Returns:
            None if nothing was typed, or if the process was stopped and goes on: its screen is to
            be drawn again. Empty when the terminal is gone or :meth:`stop` was called.
        """
        return self._next(64, seconds)

    def _next(self, most: int, seconds: float | None) -> bytes | None:
        with self._woken_by_signals():
            ready, _, _ = select.select([self._fd, self._wake_read], [], [], seconds)
        if self._wake_read in ready:
            if self._stopped:
                return b""
            os.read(self._wake_read, 1)
            return None
        if not ready:
            return None
        try:
            return os.read(self._fd, most)
        except OSError:  # what a terminal that was closed says
            return b""

    def stop(self) -> None:
        """End the present and all later reads. Safe from any thread."""
        self._stopped = True
        self._wake()

    def _wake(self) -> None:
        with contextlib.suppress(BlockingIOError):  # a full pipe wakes as well
            os.write(self._wake_write, b"\0")

    @contextlib.contextmanager
    def _woken_by_signals(self) -> Iterator[None]:
        """Let a signal end the wait within the block, so that its handler can run.

        One that comes just before the main thread begins to wait does not interrupt the wait.
        """
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        former = signal.set_wakeup_fd(self._wake_write, warn_on_full_buffer=False)
        try:
            yield
        finally:
            with contextlib.suppress(OSError, ValueError):  # a handler may have closed it
                signal.set_wakeup_fd(former)


@contextlib.contextmanager
def signals_for_this_thread(*numbers: int) -> Iterator[None]:
    """Threads that start within the block never get these signals, SIGTSTP and SIGCONT.

    For the main thread of a program that waits for keys there. The kernel hands a signal to any
    thread that takes it. The handler runs in the main thread, which goes on waiting if it was
    another one.
    """
    kept = {*numbers, signal.SIGTSTP, signal.SIGCONT}
    former = signal.pthread_sigmask(signal.SIG_BLOCK, kept)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, former)


def foreground_terminal() -> int:
    """Standard input; of a launched process, which has a pipe there, the terminal of the launch.

    Raises:
        OSError: The process has no terminal, or is in the background.
    """
    stdin = 0
    if os.isatty(stdin):
        return stdin
    terminal = os.open("/dev/tty", os.O_RDWR | os.O_NOCTTY)
    if os.tcgetpgrp(terminal) != os.getpgrp():
        os.close(terminal)
        raise OSError("in the background: a read would stop this process")
    return terminal
