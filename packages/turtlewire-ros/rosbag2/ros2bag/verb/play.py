"""``ros2 bag play``."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from ros2bag.options import (
    BAGS_TO_PLAY,
    LOG_LEVEL,
    QOS_OVERRIDES,
    READ_AHEAD,
    REMAP,
    STORAGE_CONFIG,
    absolute,
    bag_topics,
    bags_to_play,
    event_topics,
    number,
    qos_overrides,
    remap_words,
    seconds,
    seconds_from_zero,
    several,
)
from ros2bag.verb import VerbExtension
from ros2cli.arguments import argument, exclusive, unsigned_int
from ros2cli.node import NODE_NAME_PREFIX

if TYPE_CHECKING:
    from rosbag2_py import PlayOptions

__all__ = ["ARGUMENTS", "NODE_NAME_PREFIX", "PlayVerb", "main", "positive_float"]


def positive_float(arg: str) -> float:
    """Return a finite number above zero, for argparse.

    Raises:
        argparse.ArgumentTypeError: The text is not such a number.
    """
    value = number(arg)
    # Not `value <= 0`, so that NaN is rejected as well.
    if not value > 0 or math.isinf(value):
        raise argparse.ArgumentTypeError(f"{arg} is not in the valid range (> 0.0)")
    return value


ARGUMENTS = (
    *BAGS_TO_PLAY,
    READ_AHEAD,
    argument(
        "-r", "--rate", type=positive_float, default=1.0, help="Playback speed; 2 is twice as fast"
    ),
    several("--topics", "topic", "Topics to play (default: all)", bag_topics),
    several("--services", "service", "Services whose events to play (default: all)"),
    several("--actions", "action", "Actions to play (default: all)"),
    argument("-e", "--regex", default="", help="Play topics and services whose names match"),
    argument(
        "-x", "--exclude-regex", default="", help="Leave out topics and services whose names match"
    ),
    several("--exclude-topics", "topic", "Topics to leave out", bag_topics),
    several("--exclude-services", "service", "Services whose events to leave out"),
    several("--exclude-actions", "action", "Actions to leave out"),
    QOS_OVERRIDES,
    argument("-l", "--loop", action="store_true", help="Restart at the end"),
    REMAP,
    STORAGE_CONFIG,
    exclusive(
        argument(
            "--clock",
            type=positive_float,
            nargs="?",
            # rosbag2's rate.
            const=40,
            default=0,
            help="Publish /clock at this rate [Hz]; 40 if no rate is given",
        ),
        argument(
            "--clock-topics",
            nargs="+",
            default=[],
            help="Publish /clock with the messages of these topics",
            completer=bag_topics,
        ),
        argument(
            "--clock-topics-all", action="store_true", help="Publish /clock with each message"
        ),
    ),
    argument(
        "-d", "--delay", type=seconds_from_zero, default=0.0, help="Wait before each playback [s]"
    ),
    argument(
        "--playback-duration",
        type=seconds,
        default=-1.0,
        help="Length of the part to play [s]; negative for all",
    ),
    exclusive(
        argument(
            "--playback-until-sec",
            type=seconds,
            default=-1.0,
            help="Bag time at which to stop [s]; negative for the end",
        ),
        argument(
            "--playback-until-nsec",
            type=int,
            default=-1,
            help="Bag time at which to stop [ns]; negative for the end",
        ),
    ),
    argument("--disable-keyboard-controls", action="store_true", help="Do not read keys"),
    argument("-p", "--start-paused", action="store_true", help="Start paused"),
    argument(
        "--start-offset",
        type=seconds_from_zero,
        default=0.0,
        help="Position in the bag to start at [s]; earlier latched messages are published first",
    ),
    argument(
        "--wait-for-all-acked",
        metavar="TIMEOUT",
        type=int,
        default=-1,
        help="Time to wait at the end for reliable subscriptions [ms]; 0 waits without limit",
    ),
    argument(
        "--disable-loan-message",
        action="store_true",
        help="Accepted as in ROS 2; messages are never loaned",
    ),
    argument(
        "--publish-service-requests",
        action="store_true",
        help="Send recorded requests to services instead of publishing their events",
    ),
    argument(
        "--send-actions-as-client",
        action="store_true",
        help="Send recorded goals to action servers instead of publishing the topics of actions",
    ),
    argument(
        "--message-order",
        choices=("received", "sent"),
        default="received",
        help="Play messages at the times at which they were received, or sent",
    ),
    argument(
        "--progress-bar-update-rate",
        metavar="HZ",
        type=int,
        default=3,
        help="How often to draw the progress [Hz] (default: 3); 0 for never, negative for always",
    ),
    argument(
        "--progress-bar-separation-lines",
        metavar="N",
        type=unsigned_int,
        default=2,
        help="Accepted as in ROS 2; the progress is one line",
    ),
    argument(
        "--service-requests-source",
        choices=("service_introspection", "client_introspection"),
        default="service_introspection",
        help="Source of the requests to send",
    ),
    LOG_LEVEL,
)


def main(args: argparse.Namespace) -> None:
    """Play to the end of the bags, or until Ctrl-C."""
    from rosbag2_py import Player

    Player(args.log_level).play(bags_to_play(args), _play_options(args))


def _play_options(args: argparse.Namespace) -> PlayOptions:
    from rosbag2_py import MessageOrder, PlayOptions, ServiceRequestsSource

    return PlayOptions(
        read_ahead_queue_size=args.read_ahead_queue_size,
        rate=args.rate,
        topics_to_filter=args.topics,
        services_to_filter=event_topics(args.services),
        actions_to_filter=[absolute(name) for name in args.actions],
        regex_to_filter=args.regex,
        exclude_regex_to_filter=args.exclude_regex,
        exclude_topics_to_filter=args.exclude_topics,
        exclude_service_events_to_filter=event_topics(args.exclude_services),
        exclude_actions_to_filter=[absolute(name) for name in args.exclude_actions],
        send_actions_as_client=args.send_actions_as_client,
        topic_qos_profile_overrides=qos_overrides(args.qos_profile_overrides_path),
        loop=args.loop,
        topic_remapping_options=remap_words(args.remap),
        clock_publish_frequency=args.clock,
        clock_publish_on_topic_publish=args.clock_topics_all,
        clock_trigger_topics=args.clock_topics,
        delay=args.delay,
        playback_duration=args.playback_duration,
        playback_until_timestamp=PlayVerb().get_playback_until_from_arg_group(
            args.playback_until_sec, args.playback_until_nsec
        ),
        start_paused=args.start_paused,
        start_offset=args.start_offset,
        disable_keyboard_controls=args.disable_keyboard_controls,
        wait_acked_timeout=args.wait_for_all_acked,
        progress_bar_update_rate=args.progress_bar_update_rate,
        progress_bar_separation_lines=args.progress_bar_separation_lines,
        publish_service_requests=args.publish_service_requests,
        service_requests_source=ServiceRequestsSource[args.service_requests_source.upper()],
        message_order=MessageOrder[f"{args.message_order}_timestamp".upper()],
    )


class PlayVerb(VerbExtension, module=__name__):
    """Publish the messages of a bag at their times."""

    def get_playback_until_from_arg_group(
        self, playback_until_sec: float, playback_until_nsec: int
    ) -> int:
        """Return the time of the bag at which to end [ns]; negative for its end."""
        if playback_until_sec >= 0:
            return int(playback_until_sec * 1_000_000_000)
        return playback_until_nsec
