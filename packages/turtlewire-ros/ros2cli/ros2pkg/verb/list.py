"""``ros2 pkg list``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["main"]


def main(_args: argparse.Namespace) -> None:
    """Print the names, sorted."""
    from turtlewire_ros.prefix import package_names

    for name in sorted(package_names()):
        print(name)
