"""``ros2 bag reindex``."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ros2cli.commands.bag.info import bag_path

if TYPE_CHECKING:
    import argparse

__all__ = ["add_arguments", "main"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the command line."""
    from argcomplete.completers import DirectoriesCompleter

    path = parser.add_argument("bag_path", type=bag_path, help="Folder of the bag")
    path.completer = DirectoriesCompleter()  # type: ignore[attr-defined]
    parser.add_argument(
        "-s",
        "--storage",
        choices=("sqlite3", "mcap"),
        default="",
        help="Accepted as in ROS 2; the storage is found out from the files",
    )


def main(args: argparse.Namespace) -> str | None:
    """Write ``metadata.yaml`` from what the files hold."""
    from rclpy.logging import get_logger
    from rosbag2_py import Reindexer, StorageOptions

    if not os.path.isdir(args.bag_path):
        return "[ERROR] [ros2bag]: Must specify a bag directory"
    logger = get_logger("rosbag2_cpp")
    logger.info(f'Beginning reindexing bag in directory: "{args.bag_path}"')
    Reindexer().reindex(StorageOptions(uri=args.bag_path, storage_id=args.storage))
    logger.info("Reindexing complete.")
    return None
