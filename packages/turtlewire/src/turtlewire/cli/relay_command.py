"""`turtlewire relay`: carries topics, services and actions between two networks."""

from __future__ import annotations

import argparse
import signal
from typing import TYPE_CHECKING, Any

from turtlewire.terminal.parser import reporting_errors

if TYPE_CHECKING:
    from turtlewire.relay.side import End

_SAME = (
    "both ends are {}: add --namespace NS, and its names also appear in that namespace of the same "
    "network"
)


def add_relay(commands: Any) -> None:
    """Add the command to argparse's subparsers."""
    summary = "Carry topics, services, actions and parameters between two networks"
    parser = commands.add_parser(
        "relay",
        help=summary,
        description=f"{summary}, in both directions, whatever their types. A network is "
        "cyclonedds:DOMAIN (nodes on Cyclone DDS and Fast DDS) or zenoh:DOMAIN.",
    )
    for option, destination, meaning in (
        ("--from", "near", "The network whose names are put into the namespace"),
        ("--to", "far", "The other network"),
    ):
        parser.add_argument(
            option, dest=destination, type=_end, required=True, metavar="NETWORK", help=meaning
        )
    parser.add_argument(
        "--namespace",
        type=_namespace,
        default="",
        metavar="NS",
        help="Namespace of these names in the other network (default: they stay the same)",
    )
    parser.add_argument(
        "--frame-prefix",
        default="",
        metavar="PREFIX",
        help="Put PREFIX in front of the frames in /tf and /tf_static, which then stay outside NS",
    )
    parser.set_defaults(run=reporting_errors("relay", _relay), parser=parser)


def _end(text: str) -> End:
    from turtlewire.relay.side import parse_end

    try:
        return parse_end(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _namespace(text: str) -> str:
    from turtlewire.wire.names import validate_namespace

    namespace = text if text.startswith("/") else f"/{text}"
    fault = validate_namespace(namespace)
    if fault is not None:
        raise argparse.ArgumentTypeError(f"{text!r}: {fault.message}")
    return "" if namespace == "/" else namespace


def _relay(args: argparse.Namespace) -> int:
    """Carry until Ctrl-C or SIGTERM."""
    from turtlewire.relay.relay import Plan, Relay
    from turtlewire.terminal.printable import printable

    plan = Plan(args.near, args.far, args.namespace, args.frame_prefix)
    if plan.near == plan.far and not plan.namespace:
        args.parser.error(_SAME.format(plan.near))
    relay = Relay(plan, lambda line: print(printable(line), flush=True))
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: relay.end())
    try:
        print(f"relay between {plan.near} and {plan.far}: Ctrl-C ends it", flush=True)
        relay.run()
    finally:
        relay.close()
    return 0
