"""The user's browser, and the port at which a page is served."""

from __future__ import annotations

import os
import sys

__all__ = ["DEFAULT_PORT", "desktop_is_there", "open_browser", "wanted_lan", "wanted_port"]

#: The preferred port; TURTLEWIRE_PORT sets another one. The next free one is taken when it is in
#: use.
DEFAULT_PORT = 7070


def desktop_is_there() -> bool:
    """Return True if the user has a desktop, on which a browser can open."""
    if sys.platform in ("darwin", "win32"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def open_browser(url: str) -> None:
    """Open the page in the user's browser if there is a desktop and TURTLEWIRE_BROWSER is not 0."""
    if os.environ.get("TURTLEWIRE_BROWSER") != "0" and desktop_is_there():
        import webbrowser

        webbrowser.open(url)


def wanted_lan() -> bool:
    """Return True if TURTLEWIRE_LAN=1 opens pages to other devices, as --lan does.

    It is for programs that a launch file or another program starts.
    """
    return os.environ.get("TURTLEWIRE_LAN", "0") not in ("", "0")


def wanted_port() -> int:
    """Return the port to try first.

    Raises:
        ValueError: TURTLEWIRE_PORT is not a port number.
    """
    text = os.environ.get("TURTLEWIRE_PORT", "")
    if text and not (text.isdecimal() and int(text) < 65536):
        raise ValueError(
            f"TURTLEWIRE_PORT is a port number between 0 (any) and 65535, got {text!r}"
        )
    return int(text or DEFAULT_PORT)
