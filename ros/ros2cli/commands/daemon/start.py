"""``ros2 daemon start``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["main"]


def main(_args: argparse.Namespace) -> None:
    """Say why nothing is started."""
    print("No daemon is needed: every command discovers the nodes by itself")
