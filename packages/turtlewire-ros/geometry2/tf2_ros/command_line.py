"""Reads the command lines of the tools."""

from __future__ import annotations

import argparse
import sys
from typing import Any


class ToolParser(argparse.ArgumentParser):
    """A parser that exits with status 1 after an error, as ROS 2's tools do."""

    def error(self, message: str) -> Any:
        """Print the usage and the message, and exit."""
        self.print_usage(sys.stderr)
        self.exit(1, f"{self.prog}: {message}\n")


def frame_id(text: str) -> str:
    """Return a frame id; argparse prints the error of one that tf2 would reject."""
    if not text:
        raise argparse.ArgumentTypeError("in tf2 frame_ids cannot be empty")
    if text.startswith("/"):
        raise argparse.ArgumentTypeError(
            f"in tf2 frame_ids cannot start with a '/': "
            f"write {text.lstrip('/')!r} instead of {text!r}"
        )
    return text


def count(text: str) -> int:
    """Return a count; 0 means no limit."""
    return _whole(text, 1_000_000_000, "a whole number, 0 or more")


def digits(text: str) -> int:
    """Return a number of digits after the point, of which a double has up to 17."""
    return _whole(text, 17, "a whole number from 0 to 17")


def _whole(text: str, most: int, wanted: str) -> int:
    if not text.isdecimal() or int(text) > most:
        raise argparse.ArgumentTypeError(f"{text!r} is not {wanted}")
    return int(text)
