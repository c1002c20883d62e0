"""The verb ``foxglove``: serves the domain's topics to Foxglove and Lichtblick."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from typing import TYPE_CHECKING, Any

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    import argparse

    from turtlewire_view.foxglove import BridgeOptions

__all__ = ["add_foxglove_command"]

_EPILOG = """In Foxglove or Lichtblick: "Open connection", "Foxglove WebSocket", and the address
that this command prints. Other pages than those of these apps and of this computer are refused."""


def add_foxglove_command(commands: Any) -> None:
    """Add the verb to the command's parser."""
    from turtlewire.terminal.parser import reporting_errors
    from turtlewire_view.package_folders import add_package_option

    summary = "Serve topics, services and parameters to Foxglove and Lichtblick"
    parser = commands.add_parser(
        "foxglove",
        help=summary,
        description=summary,
        epilog=_EPILOG,
    )
    _add_place(parser)
    _add_offers(parser)
    add_package_option(parser)
    parser.add_argument(
        "--send-buffer-limit",
        type=int,
        default=10_000_000,
        metavar="BYTES",
        help="Bytes to queue for a slow client before dropping its oldest messages "
        "(default: %(default)s)",
    )
    parser.add_argument(
        "--use-sim-time", action="store_true", help="Use the time of /clock, and send it to clients"
    )
    parser.set_defaults(run=reporting_errors("foxglove", _foxglove), parser=parser)


def _add_place(parser: argparse.ArgumentParser) -> None:
    """Add the options for the address and for the accepted pages."""
    parser.add_argument(
        "--port",
        type=int,
        default=8765,
        metavar="N",
        help="TCP port (default: 8765); 0: a free port",
    )
    parser.add_argument(
        "--address",
        default="127.0.0.1",
        metavar="A",
        help="Address to listen on (default: 127.0.0.1, this computer only); 0.0.0.0 lets anyone "
        "on "
        "the network read all topics, publish and call services",
    )
    parser.add_argument(
        "--origin",
        action="append",
        default=[],
        metavar="PAGE",
        help="Also accept pages of this origin, such as https://example.org; may be given several "
        "times",
    )


def _add_offers(parser: argparse.ArgumentParser) -> None:
    """Add the options that limit what clients may see and do."""
    for option, what in (
        ("--topic", "Offer topics"),
        ("--service", "Offer services"),
        ("--param", "Offer parameters (/node.name)"),
        ("--client-topic", "Let clients publish on topics"),
    ):
        parser.add_argument(
            option,
            action="append",
            metavar="REGEX",
            help=f"{what} whose full name matches (default: all); may be given several times",
        )
    parser.add_argument("--hidden", action="store_true", help="Offer hidden topics and services")
    parser.add_argument(
        "--read-only",
        action="store_true",
        help="Let clients only subscribe to topics",
    )


def _foxglove(args: argparse.Namespace) -> int:
    from turtlewire import wire
    from turtlewire_view.foxglove import FoxgloveServer
    from turtlewire_view.foxglove.assets import share_folder

    named = dict(args.package)
    try:
        options = _options(args)
    except ValueError as error:
        args.parser.error(str(error))
    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda *_: ended.set())
    try:
        with contextlib.ExitStack() as stack:
            context = wire.open_context()
            stack.callback(context.close)
            node = context.create_node("foxglove_bridge")
            server = FoxgloveServer(
                context, node, options, _Log(), lambda name: named.get(name) or share_folder(name)
            )
            stack.callback(server.close)
            print(f"Foxglove and Lichtblick connect to {server.url} (Ctrl-C ends)", flush=True)
            if not options.is_local:
                print(options.warning, flush=True)
            ended.wait()
    except OSError as error:
        print(f"turtlewire foxglove: {error}.", file=sys.stderr)
        print("--port N uses another port, --port 0 a free one.", file=sys.stderr)
        return 2
    return 0


def _options(args: argparse.Namespace) -> BridgeOptions:
    from turtlewire_view.foxglove import BridgeOptions
    from turtlewire_view.foxglove.protocol import CAPABILITIES

    everything = (".*",)
    capabilities = tuple(CAPABILITIES)
    if args.read_only:
        capabilities = ("connectionGraph", "assets", "time")
    return BridgeOptions(
        port=args.port,
        address=args.address,
        topic_whitelist=tuple(args.topic or everything),
        service_whitelist=tuple(args.service or everything),
        param_whitelist=tuple(args.param or everything),
        client_topic_whitelist=tuple(args.client_topic or everything),
        include_hidden=args.hidden,
        send_buffer_limit=args.send_buffer_limit,
        use_sim_time=args.use_sim_time,
        capabilities=capabilities,
        origins=tuple(args.origin),
    )


class _Log:
    """Prints the server's log lines on stderr."""

    def info(self, message: str) -> None:
        print(printable(message), file=sys.stderr, flush=True)

    def warning(self, message: str) -> None:
        print(f"warning: {printable(message)}", file=sys.stderr, flush=True)
