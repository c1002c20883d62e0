"""What the words on the command lines of the tools may be."""

from __future__ import annotations

import argparse
import math
import sys
from typing import Any

__all__ = ["Parser", "count", "digits", "frame_id", "seconds"]


class Parser(argparse.ArgumentParser):
    """A wrong command line ends with 1, as ROS 2's tools do."""

    def error(self, message: str) -> Any:
        """Say what is wrong."""
        self.print_usage(sys.stderr)
        self.exit(1, f"{self.prog}: {message}\n")


def frame_id(text: str) -> str:
    """The id of a frame."""
    if not text:
        raise argparse.ArgumentTypeError("in tf2 frame_ids cannot be empty")
    if text.startswith("/"):
        raise argparse.ArgumentTypeError(
            f"in tf2 frame_ids cannot start with a '/': say {text.lstrip('/')!r} instead of {text!r}"
        )
    return text


def count(text: str) -> int:
    """How many; 0 for no limit."""
    return _whole(text, 1_000_000_000, "a whole number, 0 or more")


def digits(text: str) -> int:
    """Digits after the point; a double has no more than 17."""
    return _whole(text, 17, "a whole number from 0 to 17")


def _whole(text: str, most: int, wanted: str) -> int:
    if not text.isdecimal() or int(text) > most:
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
    return int(text)


def seconds(text: str) -> float:
    """A time that is not over at once."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of seconds above 0")
    return value
