"""The user's browser, the port at which a page is served, and the options for both."""

from __future__ import annotations

import argparse
import os
import sys

#: The preferred port; TURTLEWIRE_PORT sets another one. Another free one is taken when it is in
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


def add_page_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for the address of a page: ``--port`` and ``--lan``."""
    parser.add_argument(
        "--port", type=_port_number, metavar="N", help="Serve the page at this port (default: 7070)"
    )
    parser.add_argument(
        "--lan",
        action="store_true",
        help="Also serve other devices on the network, at an address with a random token",
    )


def _port_number(text: str) -> int:
    """Return a TCP port on the command line."""
    if not (text.isdecimal() and int(text) < 65536):
        raise argparse.ArgumentTypeError(f"{text!r} is not a port number, from 0 (any) to 65535")
    return int(text)
