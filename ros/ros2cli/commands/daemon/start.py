"""``ros2 daemon start``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    parser.add_argument(
        "-d", "--debug", action="store_true", help="Accepted for compatibility: there is no daemon"
    )


def main(_args: argparse.Namespace) -> None:
    """Say why nothing is started."""
    print("No daemon is needed: every command discovers the nodes by itself")
