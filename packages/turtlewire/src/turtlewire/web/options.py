"""Options of commands that serve a page."""

from __future__ import annotations

import argparse

__all__ = ["add_page_options"]


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
