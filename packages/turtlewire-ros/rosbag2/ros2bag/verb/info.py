"""``ros2 bag info``."""

from __future__ import annotations

import argparse

from ros2bag.options import BAG_PATH, STORAGE
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument

ARGUMENTS = (
    BAG_PATH,
    STORAGE,
    argument("-t", "--topic-name", action="store_true", help="Only print the names of the topics"),
    argument(
        "-v", "--verbose", action="store_true", help="Count requests and responses of services"
    ),
)


def main(args: argparse.Namespace) -> None:
    """Print what the bag holds."""
    from rosbag2_py import Info
    from rosbag2_py._metadata import action_of
    from rosbag2_transport.topic_filter import is_service_event

    if args.verbose and not args.topic_name:
        Info().read_metadata_and_output_service_verbose(args.bag_path, args.storage)
        return
    metadata = Info().read_metadata(args.bag_path, args.storage)
    if not args.topic_name:
        print(metadata)
        _tell_of_other_encodings(args.bag_path)
        return
    for item in metadata.topics_with_message_count:
        name, kind = item.topic_metadata.name, item.topic_metadata.type
        if not (is_service_event(name, kind) or action_of(name, kind)):
            print(name)


def _tell_of_other_encodings(path: str) -> None:
    from ros2cli.output import tell
    from turtlewire.bag import open_bag
    from turtlewire.bag.metadata import not_in_cdr

    with open_bag(path) as bag:
        if foreign := not_in_cdr(bag.topics.values()):
            tell(foreign)


class InfoVerb(VerbExtension, module=__name__):
    """Show what a bag holds."""
