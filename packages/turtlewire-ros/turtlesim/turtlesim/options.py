"""The command line of the simulator, outside of ``--ros-args``."""

from __future__ import annotations

import argparse
import math
import sys

from rclpy.utilities import remove_ros_args
from turtlewire.terminal.printable import printable
from turtlewire.terminal.suggestion import did_you_mean


def parse_options(args: list[str]) -> argparse.Namespace:
    """Return the options outside of ``--ros-args``.

    Unknown arguments are ignored, as in the original, and named on stderr.
    """
    from turtlewire.web.desktop import wanted_lan

    parser = argparse.ArgumentParser(
        prog="turtlesim_node",
        description="Turtles on a field, shown in the browser.",
        allow_abbrev=False,
    )
    shown = parser.add_mutually_exclusive_group()
    shown.add_argument("--headless", action="store_true", help="serve no page")
    shown.add_argument(
        "--lan",
        action="store_true",
        default=wanted_lan(),
        help="also serve the page to other devices on the network that have its address",
    )
    parser.add_argument(
        "--speed",
        type=_factor,
        metavar="N",
        help="run N times faster than real time and publish /clock; for nodes with use_sim_time",
    )
    options, unknown = parser.parse_known_args(remove_ros_args(args)[1:])
    if unknown:
        near = did_you_mean(unknown[0].partition("=")[0], parser._option_string_actions)
        text = f"turtlesim_node: ignored: {' '.join(unknown)}. {near or 'See --help'}"
        print(printable(text), file=sys.stderr)  # noqa: T201 - a command line prints
    return options


def check_port() -> None:
    """End the program if TURTLEWIRE_PORT is wrong, before the node is announced."""
    from turtlewire.web.desktop import wanted_port

    try:
        wanted_port()
    except ValueError as error:
        sys.exit(f"turtlesim_node: error: {error}")


def _factor(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"expected a number greater than 0, got {text!r}")
    return value
