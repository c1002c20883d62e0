"""The options of scripts/demo, which a Python without turtlewire can explain."""

from __future__ import annotations

import argparse
import math

from script_options import Parser


def parse() -> argparse.Namespace:
    """Return the options of the command line; end the program at a wrong one."""
    parser = Parser(
        prog="scripts/demo",
        description="One turtle follows another: the tutorial's launch file, ready to run.",
    )
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--seconds", type=seconds, help="stop after this many seconds")
    mode.add_argument(
        "--check",
        action="store_true",
        help="run headless, drive turtle1 through a square, print figures; "
        "status 0 if turtle2 followed",
    )
    return parser.parse_args()


def seconds(text: str) -> float:
    """Return a time that can be waited for."""
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(
            f"{text} is not a time to wait for; give a positive number"
        )
    return value


if __name__ == "__main__":
    parse()
