"""``ros2 bag info``."""

from __future__ import annotations

import argparse
import os

from ros2cli.arguments import argument
from ros2cli.completion import files

__all__ = ["ARGUMENTS", "bag_path", "main"]


def bag_path(text: str) -> str:
    """An existing path.

    Raises:
        argparse.ArgumentTypeError: There is nothing.
    """
    if not os.path.exists(text):
        raise argparse.ArgumentTypeError(f"Bag path '{text}' does not exist!")
    return text


ARGUMENTS = (
    argument("bag_path", type=bag_path, help="Folder of the bag, or one file", completer=files),
    argument(
        "-s",
        "--storage",
        choices=("sqlite3", "mcap"),
        default="",
        help="Accepted as in ROS 2; the storage is found out from the files",
    ),
    argument("-t", "--topic-name", action="store_true", help="Only print the names of the topics"),
    argument(
        "-v", "--verbose", action="store_true", help="Count requests and responses of services"
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print what the bag holds."""
    from rosbag2_py import Info
    from rosbag2_py._service_events import is_service_event

    if args.verbose and not args.topic_name:
        Info().read_metadata_and_output_service_verbose(args.bag_path, args.storage)
        return
    metadata = Info().read_metadata(args.bag_path, args.storage)
    if not args.topic_name:
        print(metadata)
        return
    for item in metadata.topics_with_message_count:
        if not is_service_event(item.topic_metadata.name, item.topic_metadata.type):
            print(item.topic_metadata.name)
