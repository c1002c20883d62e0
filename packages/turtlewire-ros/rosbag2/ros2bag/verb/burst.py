"""``ros2 bag burst``."""

from __future__ import annotations

import argparse

from ros2bag.options import (
    BAGS_TO_PLAY,
    QOS_OVERRIDES,
    READ_AHEAD,
    REMAP,
    STORAGE_CONFIG,
    absolute,
    bag_topics,
    bags_to_play,
    event_topics,
    qos_overrides,
    remap_words,
    seconds_from_zero,
    several,
)
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument, unsigned_int
from ros2cli.node import NODE_NAME_PREFIX

__all__ = ["ARGUMENTS", "NODE_NAME_PREFIX", "BurstVerb", "main"]

ARGUMENTS = (
    *BAGS_TO_PLAY,
    READ_AHEAD,
    several("--topics", "topic", "Topics to publish (default: all)", bag_topics),
    several("--services", "service", "Services whose events to publish (default: all)"),
    several("--actions", "action", "Actions to publish (default: all)"),
    QOS_OVERRIDES,
    REMAP,
    STORAGE_CONFIG,
    argument(
        "--start-offset",
        type=seconds_from_zero,
        default=0.0,
        help="Position in the bag to start at [s]",
    ),
    argument(
        "-n",
        "--num-messages",
        type=unsigned_int,
        default=0,
        help="Number of messages to publish; 0 for all",
    ),
)


def main(args: argparse.Namespace) -> None:
    """Publish the messages at once, then wait paused until Ctrl-C."""
    from rosbag2_py import Player, PlayOptions

    options = PlayOptions(
        read_ahead_queue_size=args.read_ahead_queue_size,
        topics_to_filter=args.topics,
        services_to_filter=event_topics(args.services),
        actions_to_filter=[absolute(name) for name in args.actions],
        topic_qos_profile_overrides=qos_overrides(args.qos_profile_overrides_path),
        topic_remapping_options=remap_words(args.remap),
        start_offset=args.start_offset,
        start_paused=True,
    )
    Player().burst(bags_to_play(args), options, args.num_messages)


class BurstVerb(VerbExtension, module=__name__):
    """Publish the first messages of a bag at once."""
