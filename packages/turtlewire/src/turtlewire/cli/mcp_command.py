"""`turtlewire mcp`: lets an assistant look at the network."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from turtlewire.terminal.parser import reporting_errors

_MISSING = (
    "turtlewire mcp needs the official SDK of the Model Context Protocol, version 2: "
    "pip install 'turtlewire[mcp]', or pip install 'mcp>=2' pypdfium2"
)


def add_mcp(commands: Any) -> None:
    """Add the command to argparse's subparsers."""
    summary = "Let an assistant look at topics and transforms (MCP on stdin and stdout)"
    parser = commands.add_parser(
        "mcp",
        help=summary,
        description=f"{summary}. It is read-only, except for what --allow names.",
    )
    parser.add_argument(
        "--allow",
        action="append",
        default=[],
        metavar="NAME",
        help="Topic that may be published to, or service that may be called; '/turtle1/*' is all "
        "whose names begin like this. May be given more than once",
    )
    parser.add_argument(
        "--rate",
        type=_rate,
        default=60,
        metavar="N",
        help="Calls of tools that are answered in a minute (default: %(default)s)",
    )
    parser.set_defaults(run=reporting_errors("mcp", _mcp), parser=parser)


def _rate(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number of calls, at least 1")
    return int(text)


def _mcp(args: argparse.Namespace) -> int:
    """Serve until the client closes stdin, or Ctrl-C."""
    from turtlewire.cli.assistant.permissions import Permissions

    try:
        permissions = Permissions(args.allow)
    except ValueError as error:
        args.parser.error(f"--allow: {error}")
    try:
        from turtlewire.cli.assistant import server
    except ImportError as error:  # also of version 1, which has other names
        if (error.name or "").partition(".")[0] not in {"mcp", "mcp_types", "anyio"}:
            raise
        print(_MISSING, file=sys.stderr)
        return 2
    if sys.stdin is None or sys.stdout is None:
        print("turtlewire mcp: needs stdin and stdout, and one of them is closed", file=sys.stderr)
        return 2
    from turtlewire.cli.assistant.network import Network

    network = Network()
    in_terminal = sys.stdin.isatty()
    server.make_stdin_endable()
    with network:
        _announce(permissions, in_terminal=in_terminal)
        server.serve(server.make_server(network, permissions, args.rate))
    return 0


def _announce(permissions: object, *, in_terminal: bool) -> None:
    """Say on stderr what is going on, because stdout belongs to the protocol."""
    lines = [f"turtlewire mcp: assistants may read, and use: {permissions}"]
    if in_terminal:
        lines.append("An assistant's program starts this command and writes to it; Ctrl-C ends it")
    print("\n".join(lines), file=sys.stderr, flush=True)
