"""Imports ``eclipse-zenoh`` if it is installed, and defines its errors, for the other modules."""

from __future__ import annotations

import re
from importlib import import_module

from turtlewire.errors import WireError
from turtlewire.wire.wheels import advice, this_platform


def require_zenoh() -> None:
    """Import the library.

    Raises:
        WireError: Zenoh, or ``xxhash``, which computes gids, is not installed or does not run here.
    """
    try:
        import_module("zenoh")
        import_module("xxhash")
    except ImportError as error:
        failed = WireError(f"Zenoh is not available: {error}")
        here = this_platform()
        hint = "Type: pip install 'turtlewire[zenoh]'." if here.has_zenoh else advice(here)
        raise failed.with_hint(hint) from error


def reason_of(error: Exception) -> str:
    """Return a ``ZError``'s message in one line, without places in Zenoh's sources."""
    said = re.sub(r"\s+at \S+\.rs:\d+\.?", "", str(error))
    # A picture of the place where JSON5 cannot be read.
    place = re.match(r"\s*--> (\d+):(\d+)\s.*= ([^\n]*)", said, re.DOTALL)
    return f"line {place[1]}: {place[3]}" if place else " ".join(said.split())
