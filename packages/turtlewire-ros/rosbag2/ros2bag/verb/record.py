"""``ros2 bag record``."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ros2bag.options import (
    LOG_LEVEL,
    QOS_OVERRIDES,
    STORAGES,
    absolute,
    custom_data,
    event_topics,
    existing_file,
    qos_overrides,
    several,
)
from ros2bag.verb import VerbExtension
from ros2cli import arguments
from ros2cli.arguments import argument, exclusive, positive_int, unsigned_int
from ros2cli.completion import action_names, files, message_types, service_names, topic_names
from ros2cli.node import NODE_NAME_PREFIX
from turtlewire.distro import KILTED, LYRICAL, since

if TYPE_CHECKING:
    from rosbag2_py import RecordOptions, StorageOptions

__all__ = [
    "ARGUMENTS",
    "NODE_NAME_PREFIX",
    "RecordVerb",
    "add_recorder_arguments",
    "check_necessary_argument",
    "main",
    "parse_repeat_transient_local_topics",
    "split_key_value",
    "validate_parsed_arguments",
]

_ERROR, _WARN = "[ERROR] [ros2bag]: ", "[WARN] [ros2bag]: "
_NOTHING_CHOSEN = (
    "Need to specify at least one option out of --all, --all-topics, --all-services, --services, "
    "--topics, --topic-types or --regex"
)
_TWO_CLOCKS = (
    "--use-sim-time and --no-discovery both set, but are incompatible settings. The /clock topic "
    "needs to be discovered to record with sim time."
)
_FILES_ALONE = "--max-bag-files argument requires either --max-bag-size or --max-bag-duration"
_FORMAT_ALONE = "Invalid choice: Cannot specify compression format without a compression mode."
_POSITIONAL = (
    'Positional "topics" argument deprecated. Please use optional "--topics" argument instead.'
)

_TOPICS = several("--topics", "topic", "Names of topics to record", topic_names)
_POSITIONAL_TOPICS = argument(
    "topics_positional",
    metavar="topic",
    nargs="*",
    default=[],
    help="Names of topics to record; --topics is better",
    completer=topic_names,
)

ARGUMENTS = (
    _TOPICS if since(LYRICAL) else exclusive(_POSITIONAL_TOPICS, _TOPICS),
    argument(
        "-o", "--output", help="Folder of the new bag (default: named after the current time)"
    ),
    argument(
        "-s",
        "--storage",
        choices=STORAGES,
        default="mcap",
        help="Storage format (default: mcap)",
    ),
    several("--services", "service", "Services whose events to record", service_names),
    several(
        "--actions",
        "action",
        "Actions to record: feedback, status, and the events of their services",
        action_names,
    ),
    several("--topic-types", "type", "Types of topics to record", message_types),
    argument(
        "--static-topics-path",
        type=existing_file,
        help="YAML file with topics and types to subscribe to at once, without a publisher",
        completer=files,
    ),
    argument(
        "-a",
        "--all",
        action="store_true",
        help="Record all topics and service events, and from Kilted on all actions",
    ),
    argument("--all-topics", action="store_true", help="Record all topics"),
    argument("--all-services", action="store_true", help="Record the events of all services"),
    argument("--all-actions", action="store_true", help="Record all actions"),
    argument(
        "-e", "--regex", default="", help="Record topics and services whose names contain a match"
    ),
    argument(
        "--exclude-regex", default="", help="Leave out topics and services with a match in the name"
    ),
    several("--exclude-topic-types", "type", "Types of topics to leave out", message_types),
    several("--exclude-topics", "topic", "Topics to leave out", topic_names),
    several("--exclude-services", "service", "Services whose events to leave out", service_names),
    several("--exclude-actions", "action", "Actions to leave out", action_names),
    argument(
        "--include-unpublished-topics",
        action="store_true",
        help="Also record topics that have only subscriptions",
    ),
    argument(
        "--include-hidden-topics",
        action="store_true",
        help="Also record topics with a name part that starts with _",
    ),
    argument("--no-discovery", action="store_true", help="Look for topics only once"),
    argument(
        "-p",
        "--polling-interval",
        type=unsigned_int,
        # rosbag2's default.
        default=100,
        help="Interval between two checks of the graph [ms]",
    ),
    argument(
        "--ignore-leaf-topics", action="store_true", help="Leave out topics without subscriptions"
    ),
    QOS_OVERRIDES,
    argument(
        "-f",
        "--serialization-format",
        choices=("cdr",),
        default="",
        help="Accepted as in ROS 2; messages are always kept as cdr",
    ),
    argument(
        "-b",
        "--max-bag-size",
        type=unsigned_int,
        default=0,
        help="Size at which to start a new file [bytes]; 0 for a single file",
    ),
    argument(
        "-d",
        "--max-bag-duration",
        type=unsigned_int,
        default=0,
        help="Time after which to start a new file [s]; 0 for a single file",
    ),
    argument(
        "--max-bag-files",
        metavar="N",
        type=unsigned_int,
        default=0,
        help="Keep the N newest files of the bag; 0 for all",
    ),
    argument(
        "--repeat-transient-local",
        metavar="topic[=DEPTH]",
        nargs="+",
        default=[],
        help="Write the last DEPTH messages (default: 1) of latched topics again into each further "
        "file and snapshot",
        completer=topic_names,
    ),
    argument(
        "--repeat-all-transient-local",
        metavar="DEPTH",
        nargs="?",
        type=positive_int,
        const=1,
        default=0,
        help="The same for all latched topics (default: 1)",
    ),
    argument(
        "--max-cache-size",
        type=unsigned_int,
        # rosbag2's default.
        default=100 * 1024 * 1024,
        help="Size of the queue in front of the disk [bytes]; 0 for no limit",
    ),
    argument(
        "--max-cache-duration",
        metavar="S",
        type=unsigned_int,
        default=0,
        help="Time span of the messages in a snapshot [s]; 0 for no limit",
    ),
    argument("--disable-keyboard-controls", action="store_true", help="Do not read keys"),
    argument("--start-paused", action="store_true", help="Start paused"),
    argument("--use-sim-time", action="store_true", help="Use the time of /clock"),
    argument("--node-name", default="rosbag2_recorder", help="Name of the recorder's node"),
    argument(
        "--custom-data",
        type=custom_data,
        metavar="KEY=VALUE",
        nargs="+",
        default=[],
        help="Strings to store in the bag's metadata",
    ),
    argument(
        "--snapshot-mode",
        action="store_true",
        help="Write the messages in the cache only when the service ~/snapshot is called",
    ),
    LOG_LEVEL,
    argument(
        "--storage-config-file",
        type=existing_file,
        help="YAML with options of the storage",
        completer=files,
    ),
    argument(
        "--storage-preset-profile",
        choices=("none", "fastwrite", "zstd_fast", "zstd_small", "resilient"),
        default="none",
        help="Options of the storage by name",
    ),
    argument(
        "--compression-queue-size",
        type=unsigned_int,
        default=1,
        help="Accepted as in ROS 2; --max-cache-size limits the queue",
    ),
    argument("--compression-threads", type=unsigned_int, default=0, help="Accepted as in ROS 2"),
    argument("--compression-threads-priority", type=int, default=0, help="Accepted as in ROS 2"),
    argument(
        "--compression-mode",
        choices=("none", "file", "message"),
        default="none",
        help="Compress nothing, whole files, or (sqlite3) single messages",
    ),
    argument(
        "--compression-format", choices=("zstd",), default="", help="Compression format: zstd"
    ),
)


def main(args: argparse.Namespace) -> str | None:
    """Record until Ctrl-C."""
    if getattr(args, "topics_positional", []):  # gone in Lyrical
        print(f"{_WARN}{_POSITIONAL}")
        # The two forms exclude each other, so nothing is overwritten.
        args.topics = args.topics_positional
    wrong = validate_parsed_arguments(args, args.output)
    if wrong is not None:
        return wrong
    from rosbag2_py import Recorder

    try:
        storage, options = _storage_options(args), _record_options(args)
    except ValueError as error:
        return f"{_ERROR}{error}"
    Recorder(args.log_level).record(storage, options, args.node_name)
    return None


def add_recorder_arguments(parser: argparse.ArgumentParser) -> None:
    """Add all options of ``ros2 bag record`` to a command line."""
    arguments.add_arguments(parser, ARGUMENTS)


def check_necessary_argument(args: argparse.Namespace) -> bool:
    """Return True if an option chooses what to record."""
    everything = (args.all, args.all_topics, args.all_services, args.all_actions)
    by_name = (args.topics, args.topic_types, args.services, args.actions)
    return any((*everything, args.regex, args.static_topics_path, *by_name))


def split_key_value(entry: str, default_value: str = "") -> tuple[str, str]:
    """Split ``key=value`` at the first sign; the default stands for a missing value.

    Args:
        entry: A word of the command line.
        default_value: Stands for a value that is not given.
    """
    key, sign, value = entry.partition("=")
    return key, value if sign else default_value


def parse_repeat_transient_local_topics(values: Iterable[str]) -> dict[str, int]:
    """Return how many messages to repeat, by topic.

    Args:
        values: Words such as ``/tf_static=10``; a name alone means one message.

    Raises:
        ValueError: A word has no name, or its depth is not a number above zero.
    """
    depths = {}
    for word in values:
        topic, depth = split_key_value(word, "1")
        if not topic or not depth.isdecimal() or not int(depth):
            raise ValueError(
                f"--repeat-transient-local takes TOPIC or TOPIC=DEPTH with a depth from 1, "
                f"not '{word}'"
            )
        depths[absolute(topic)] = int(depth)
    return depths


def validate_parsed_arguments(args: argparse.Namespace, uri: str | None) -> str | None:
    """Return the conflict between options, if any; print which options override others.

    Args:
        args: The command line.
        uri: Folder of the new bag; None for a folder with a new name.
    """
    wrong = _wrong_combination(args, uri)
    return None if wrong is None else f"{_ERROR}{wrong}"


def _wrong_combination(args: argparse.Namespace, uri: str | None) -> str | None:
    if not check_necessary_argument(args):
        return _NOTHING_CHOSEN
    topics, services = args.all or args.all_topics, args.all or args.all_services
    # As in ROS 2, only warnings: the wider option wins.
    for name, given in (("--topics", args.topics), ("--topic-types", args.topic_types)):
        if topics and given:
            print(f"{_WARN}--all or --all-topics will override {name}")
    if services and args.services:
        print(f"{_WARN}--all or --all-services will override --services")
    if (topics or services) and args.regex:
        print(f"{_WARN}--all, --all-topics or --all-services will override --regex")
    if uri and os.path.exists(uri):
        return f"Output folder '{uri}' already exists."
    if args.use_sim_time and args.no_discovery:
        return _TWO_CLOCKS
    if args.compression_format and args.compression_mode == "none":
        return _FORMAT_ALONE
    if args.max_bag_files and not (args.max_bag_size or args.max_bag_duration):
        return _FILES_ALONE
    return _useless_exclusion(args, topics, services)


def _useless_exclusion(args: argparse.Namespace, topics: bool, services: bool) -> str | None:
    regex = bool(args.regex)
    by_type = bool(args.topic_types)
    for name, given, useful, needs in (
        (
            "--exclude-regex",
            args.exclude_regex,
            topics or services or regex or by_type,
            "--all, --all-topics, --all-services or --regex",
        ),
        (
            "--exclude-topics",
            args.exclude_topics,
            topics or regex or by_type,
            "--all, --all-topics or --regex",
        ),
        (
            "--exclude-topic-types",
            args.exclude_topic_types,
            topics or regex,
            "--all, --all-topics or --regex",
        ),
        (
            "--exclude-services",
            args.exclude_services,
            services or regex,
            "--all, --all-services or --regex",
        ),
        (
            "--exclude-actions",
            args.exclude_actions,
            args.all or args.all_actions or regex,
            "--all, --all-actions or --regex",
        ),
    ):
        if given and not useful:
            return f"{name} argument requires either {needs}"
    return None


def _storage_options(args: argparse.Namespace) -> StorageOptions:
    from rosbag2_py import StorageOptions

    return StorageOptions(
        # ROS 2's pattern of names, in local time.
        uri=args.output or time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"),
        storage_id=args.storage,
        max_bagfile_size=args.max_bag_size,
        max_bagfile_duration=args.max_bag_duration,
        max_bag_files=args.max_bag_files,
        max_cache_size=args.max_cache_size,
        max_cache_duration=args.max_cache_duration,
        storage_preset_profile=args.storage_preset_profile,
        storage_config_uri=args.storage_config_file or "",
        snapshot_mode=args.snapshot_mode,
        custom_data=dict(args.custom_data),
    )


def _record_options(args: argparse.Namespace) -> RecordOptions:
    from datetime import timedelta

    from rosbag2_py import RecordOptions

    return RecordOptions(
        all_topics=args.all or args.all_topics,
        all_services=args.all or args.all_services,
        is_discovery_disabled=args.no_discovery,
        topics=[absolute(name) for name in args.topics],
        topic_types=args.topic_types,
        services=event_topics(args.services),
        all_actions=args.all_actions or (args.all and since(KILTED)),
        actions=[absolute(name) for name in args.actions],
        exclude_actions=[absolute(name) for name in args.exclude_actions],
        exclude_topics=[absolute(name) for name in args.exclude_topics],
        exclude_topic_types=args.exclude_topic_types,
        exclude_service_events=event_topics(args.exclude_services),
        rmw_serialization_format=args.serialization_format,
        topic_polling_interval=timedelta(milliseconds=args.polling_interval),
        repeat_transient_local_messages=parse_repeat_transient_local_topics(
            args.repeat_transient_local
        ),
        repeat_all_transient_local_depth=args.repeat_all_transient_local,
        static_topics_uri=args.static_topics_path or "",
        regex=args.regex,
        exclude_regex=args.exclude_regex,
        compression_mode=args.compression_mode,
        compression_format=args.compression_format,
        compression_queue_size=args.compression_queue_size,
        compression_threads=args.compression_threads,
        compression_threads_priority=args.compression_threads_priority,
        topic_qos_profile_overrides=qos_overrides(args.qos_profile_overrides_path),
        include_hidden_topics=args.include_hidden_topics,
        include_unpublished_topics=args.include_unpublished_topics,
        ignore_leaf_topics=args.ignore_leaf_topics,
        start_paused=args.start_paused,
        use_sim_time=args.use_sim_time,
        disable_keyboard_controls=args.disable_keyboard_controls,
    )


class RecordVerb(VerbExtension, module=__name__):
    """Record topics and service events into a bag."""
