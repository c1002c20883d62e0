"""Ends a program as Unix tools do when they cannot write their output.

``git``, ``ls`` and ``cat`` end silently when the reader of their output, such as ``head``, has
closed the pipe: SIGPIPE ends them, and a shell shows the status 141. When the disk is
full, they print one line. Python ignores SIGPIPE, prints a traceback, and "Exception ignored in …"
with the status 120 for what is in its buffers at the exit.
"""

from __future__ import annotations

import errno
import functools
import importlib
import io
import os
import signal
import sys
import threading
from collections.abc import Callable
from typing import Any, ParamSpec, TextIO, TypeVar

_Arguments = ParamSpec("_Arguments")
_Status = TypeVar("_Status", bound="int | str | None")

_READER_GONE = 141


def program(main: Callable[_Arguments, _Status]) -> Callable[_Arguments, _Status | int | str]:
    """Decorate the function that runs a command and returns its exit status.

    If stdout cannot be written, the write raises ``SystemExit``, so that ``main`` cleans up: with
    the status 141 and no text if the reader of a pipe has closed it, else with the status 1 and one
    line on stderr. If no one reads stderr, the status is also 141, but ``main`` continues: log
    lines that no one reads must not end a node.

    Nothing changes if stdout is not the one of the process, as in tests that capture it.
    """

    @functools.wraps(main)
    def run(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> _Status | int | str:
        before = sys.stdout
        if not isinstance(before, io.TextIOWrapper) or before is not sys.__stdout__:
            return main(*args, **kwargs)
        before.flush()
        raw = _Output(before.fileno(), "w", closefd=False)
        sys.stdout = io.TextIOWrapper(
            raw if before.write_through else io.BufferedWriter(raw),  # `python -u` has no buffer
            encoding=before.encoding,
            errors=before.errors,
            line_buffering=before.line_buffering,
            write_through=before.write_through,
        )
        status: _Status | int | str
        try:
            status = main(*args, **kwargs)
        except KeyboardInterrupt:
            if raw.end is None:
                raise
            status = raw.end
        finally:
            sys.stdout.flush()
            sys.stdout = before
            _flush_stderr()
        return status if raw.end is None else raw.end

    return run


def run_executable(entry_point: str) -> int | str | None:
    """Import the function ``module:function`` and run it, decorated with :func:`program`.

    Ctrl-C during the imports ends the process with SIGINT, without a traceback: Python drops an
    exception that comes at the end of an import, and the process would go on.

    Returns:
        What ``sys.exit`` takes.
    """
    interrupts = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if interrupts:  # not if the parent ignores SIGINT
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    module, _, function = entry_point.partition(":")
    main: Callable[[], int | str | None] = getattr(importlib.import_module(module), function)
    if interrupts:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    return program(main)()


def open_output(descriptor: int) -> TextIO:
    """Open a file descriptor for text; a write that fails ends the program as :func:`program` says.

    Args:
        descriptor: The stream closes it.
    """
    return io.TextIOWrapper(io.BufferedWriter(_Output(descriptor, "w")), encoding="utf-8")


class _Output(io.FileIO):
    """A file descriptor; the first write that fails ends the program.

    Attributes:
        end: What ``sys.exit`` takes after a failed write, else None.
    """

    end: int | str | None = None

    def write(self, data: Any) -> int:
        """Write the bytes, or end the program."""
        try:
            return super().write(data)
        except OSError as error:
            _discard(self.fileno())
            name = os.path.basename(sys.argv[0])
            gone = error.errno == errno.EPIPE
            self.end = _READER_GONE if gone else f"{name}: write error: {error.strerror}"
            _interrupt_main_thread()
            raise SystemExit(self.end) from error


def _interrupt_main_thread() -> None:
    """End the program as Ctrl-C does, if another thread could not write."""
    main = threading.main_thread()
    if sys.platform != "win32" and main is not threading.current_thread() and main.ident:
        signal.pthread_kill(main.ident, signal.SIGINT)  # also wakes a main thread that waits


def _flush_stderr() -> None:
    try:
        if sys.stderr is not None:
            sys.stderr.flush()
    except OSError as error:
        _discard(sys.stderr.fileno())
        if error.errno == errno.EPIPE:
            raise SystemExit(_READER_GONE) from error


def _discard(descriptor: int) -> None:
    """Discard what is written from now on: what is left in the buffers must not fail again."""
    unread = os.open(os.devnull, os.O_WRONLY)
    os.dup2(unread, descriptor)
    os.close(unread)
