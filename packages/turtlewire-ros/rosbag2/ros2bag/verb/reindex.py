"""``ros2 bag reindex``."""

from __future__ import annotations

import argparse
import os
import time

from ros2bag.options import STORAGE, bag_path
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument
from ros2cli.completion import folders

ARGUMENTS = (
    argument("bag_path", type=bag_path, help="Folder of the bag", completer=folders),
    STORAGE,
)


def main(args: argparse.Namespace) -> str | None:
    """Write ``metadata.yaml`` from what the files hold."""
    from rclpy.logging import get_logger
    from rosbag2_py import Reindexer, StorageOptions
    from rosbag2_transport.progress import ProgressLine, time_text

    if not os.path.isdir(args.bag_path):
        return "[ERROR] [ros2bag]: Must specify a bag directory"
    logger = get_logger("rosbag2_cpp")
    logger.info(f'Beginning reindexing bag in directory: "{args.bag_path}"')
    started = time.monotonic()
    with ProgressLine(lambda: f"reindexing: {time_text(time.monotonic() - started)}"):
        Reindexer().reindex(StorageOptions(uri=args.bag_path, storage_id=args.storage))
    logger.info("Reindexing complete.")
    return None


class ReindexVerb(VerbExtension, module=__name__):
    """Rebuild the metadata of a bag, for example after a recorder was killed."""
