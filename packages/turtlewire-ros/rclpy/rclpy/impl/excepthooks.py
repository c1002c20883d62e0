"""Ctrl-C ends a program without a traceback when the program does not catch ``KeyboardInterrupt``.

The user asked the program to end, so its position does not matter, even during imports. The exit
status stays that of an interrupted program. The same goes for threads that spin:
``ExternalShutdownException`` tells them that the program ends, and is not an error. An unreadable
command line is reported in one line, and so are settings with which no context can be opened. Where
Python drops exceptions, within a destructor or a callback of a weak reference (at the end of each
import there is one), Ctrl-C is raised again right afterwards.
"""

from __future__ import annotations

import _thread
import functools
import signal
import sys
import threading
import weakref
from signal import SIGINT
from types import TracebackType

from turtlewire.package_sources import explain_missing_modules

_previous_hook = sys.excepthook
_previous_thread_hook = threading.excepthook
_previous_unraisable_hook = sys.unraisablehook
_signal_came = False
_dropped = False
#: Keeps the callback of the last dropped interrupt.
_guard_reference: weakref.ref[set[signal.Signals]] | None = None


def install() -> None:
    """Install the hooks, which call the hooks that were in place. Idempotent."""
    global _previous_hook, _previous_thread_hook
    if sys.excepthook is not _hook:
        _previous_hook, sys.excepthook = sys.excepthook, _hook
    if threading.excepthook is not _thread_hook:
        _previous_thread_hook, threading.excepthook = threading.excepthook, _thread_hook


def note_signal() -> None:
    """Note a signal that shuts contexts down: errors that follow from it are not the program's."""
    global _signal_came  # noqa: PLW0603 - there is one in the process
    _signal_came = True


def take_dropped() -> bool:
    """Return True if Python dropped the last ``KeyboardInterrupt``, which is raised again."""
    global _dropped
    dropped, _dropped = _dropped, False
    return dropped


def _hook(kind: type[BaseException], value: BaseException, traceback: TracebackType | None) -> None:
    if hasattr(sys, "ps1"):  # at a prompt, the traceback shows the interrupted line
        _previous_hook(kind, value, traceback)
    elif getattr(value, "is_of_command_line", False) or _is_of_the_command_line(traceback):
        _previous_hook(kind, value.with_traceback(None), None)
    elif getattr(value, "is_of_environment", False):
        sys.stderr.write(f"{value.in_one_line()}\n")  # type: ignore[attr-defined]
    elif not issubclass(kind, KeyboardInterrupt):
        _previous_hook(kind, value, traceback)


def _is_of_the_command_line(traceback: TracebackType | None) -> bool:
    """Return True if ``--ros-args`` could not be read.

    The text says all, and the program is not at fault.
    """
    while traceback is not None and traceback.tb_next is not None:
        traceback = traceback.tb_next
    return (
        traceback is not None
        and traceback.tb_frame.f_globals.get("__name__") == "rclpy.impl.arguments"
    )


def _thread_hook(arguments: threading.ExceptHookArgs) -> None:
    from rclpy._execution.exceptions import ExternalShutdownException

    if not (_signal_came and issubclass(arguments.exc_type, ExternalShutdownException)):
        _previous_thread_hook(arguments)


def _unraisable_hook(arguments: sys.UnraisableHookArgs) -> None:
    global _dropped  # noqa: PLW0603 - there is one in the process
    if (
        not issubclass(arguments.exc_type, KeyboardInterrupt)
        or threading.current_thread() is not threading.main_thread()
    ):
        _previous_unraisable_hook(arguments)
        return
    _dropped = True
    frame_guard = {SIGINT}
    _raise_again_after(frame_guard)


def _raise_again_after(frame_guard: set[signal.Signals]) -> None:
    """Raise SIGINT in the main thread once the frame that holds ``frame_guard`` has ended.

    Within that frame Python would drop the exception again. The callback has to be in C: a function
    in Python would itself be the first to be interrupted. :func:`next` ignores the dead reference,
    which is its default, and calls ``interrupt_main``.
    """
    global _guard_reference  # noqa: PLW0603 - there is one in the process
    call = functools.partial(next, map(_thread.interrupt_main, (SIGINT,)))
    _guard_reference = weakref.ref(frame_guard, call)


explain_missing_modules()  # before `install`, whose hook calls the previous hook
sys.unraisablehook = _unraisable_hook
install()  # at once: most of what a node does in its first moments is importing
