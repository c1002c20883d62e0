"""Whether ``eclipse-zenoh`` is here; the other modules import it at their top."""

from __future__ import annotations

from importlib import import_module

from turtlewire.errors import WireError

__all__ = ["require_zenoh"]


def require_zenoh() -> None:
    """Import the library.

    Raises:
        WireError: It, or ``xxhash``, which computes gids, is not installed or does not run here.
    """
    try:
        import_module("zenoh")
        import_module("xxhash")
    except ImportError as error:
        failed = WireError(f"Zenoh is not available: {error}")
        raise failed.with_hint("Install it: pip install 'turtlewire[zenoh]'") from error
