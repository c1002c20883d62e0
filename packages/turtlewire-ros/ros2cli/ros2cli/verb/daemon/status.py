"""``ros2 daemon status``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["main"]


def main(_args: argparse.Namespace) -> None:
    """Say that no daemon exists."""
    print("The daemon is not running")
