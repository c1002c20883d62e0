"""Functions on the default context, and small helpers."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from .constants import S_TO_NS

if TYPE_CHECKING:
    from .context import Context

__all__ = [
    "S_TO_NS",
    "g_default_context",
    "get_available_rmw_implementations",
    "get_default_context",
    "get_rmw_implementation_identifier",
    "ok",
    "remove_ros_args",
    "shutdown",
    "timeout_sec_to_nsec",
    "try_shutdown",
]

g_default_context: Context | None = None
_lock = threading.Lock()


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Return the default context.

    Args:
        shutting_down: Return it for the last time: the next call makes a new one, so that ``init``
            can follow ``shutdown``.
    """
    global g_default_context  # noqa: PLW0603 - there is one for the process
    from .context import Context

    with _lock:
        context = Context() if g_default_context is None else g_default_context
        g_default_context = None if shutting_down else context
        return context


def ok(*, context: Context | None = None) -> bool:
    """Return True if ``context``, or the default one, is initialized and not shut down."""
    return (get_default_context() if context is None else context).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shut a context down (None: the default one); see :meth:`rclpy.context.Context.shutdown`."""
    (get_default_context(shutting_down=True) if context is None else context).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shut a context down (None: the default one) unless that has happened.

    Never raises for that.
    """
    (get_default_context(shutting_down=True) if context is None else context).try_shutdown()


def remove_ros_args(args: list[str] | None = None) -> list[str]:
    """Return ``args`` (None: ``sys.argv``) without its ``--ros-args`` blocks.

    The first entry, the program, stays.
    """
    import sys

    from .impl.arguments import Arguments

    return list(Arguments.parse(sys.argv if args is None else args).user_args)


def get_rmw_implementation_identifier() -> str:
    """Return the middleware: ``rmw_cyclonedds_cpp`` unless ``RMW_IMPLEMENTATION`` names another."""
    from turtlewire.wire.environment import middleware_name

    return middleware_name()


def get_available_rmw_implementations() -> set[str]:
    """Return the middlewares that ``RMW_IMPLEMENTATION`` may name to talk to other processes."""
    from turtlewire.wire.environment import MIDDLEWARES, is_installed

    return {name for name in MIDDLEWARES if name.startswith("rmw_") and is_installed(name)}


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Convert seconds to nanoseconds; None and negative values ("no limit") to -1."""
    return -1 if timeout_sec is None or timeout_sec < 0 else int(float(timeout_sec) * S_TO_NS)
