"""Options that several verbs of ``ros2 bag`` have."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import argument, unsigned_int
from ros2cli.completion import files

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from ros2cli.arguments import Argument, Completer
    from rosbag2_py import StorageOptions

STORAGES = ("mcap", "sqlite3")

LOG_LEVEL = argument(
    "--log-level",
    choices=("debug", "info", "warn", "error", "fatal"),
    default="info",
    help="Lowest severity to log",
)


def existing_file(text: str) -> str:
    """Return a file that exists.

    Raises:
        argparse.ArgumentTypeError: The file does not exist.
    """
    if not os.path.isfile(text):
        raise argparse.ArgumentTypeError(f"file '{text}' does not exist!")
    return text


QOS_OVERRIDES = argument(
    "--qos-profile-overrides-path",
    type=existing_file,
    help="YAML with QoS profiles by topic",
    completer=files,
)


def bag_path(text: str) -> str:
    """Return an existing path.

    Raises:
        argparse.ArgumentTypeError: The path does not exist.
    """
    if not os.path.exists(text):
        raise argparse.ArgumentTypeError(f"Bag path '{text}' does not exist!")
    return text


BAG_PATH = argument(
    "bag_path", type=bag_path, help="Folder of the bag, or one file", completer=files
)

STORAGE = argument(
    "-s",
    "--storage",
    choices=STORAGES,
    default="",
    help="Accepted as in ROS 2; the storage is detected from the files",
)

STORAGE_CONFIG = argument(
    "--storage-config-file",
    type=existing_file,
    help="Accepted as in ROS 2; has no effect on reading",
    completer=files,
)

READ_AHEAD = argument(
    "--read-ahead-queue-size",
    type=unsigned_int,
    default=1000,
    help="Number of messages to read ahead",
)

REMAP = argument(
    "-m",
    "--remap",
    nargs="+",
    default=[],
    help="New names of topics, for example /tf:=/old_tf",
)


#: What 64 bits of nanoseconds hold, in seconds.
_MOST_SECONDS = 9223372036.0


def number(text: str) -> float:
    """Return a number, for argparse.

    Raises:
        argparse.ArgumentTypeError: The text is not a number.
    """
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not the valid type (float)") from None


def seconds(text: str) -> float:
    """Return a number of seconds that fits into 64 bits of nanoseconds, or a negative one.

    Raises:
        argparse.ArgumentTypeError: The text is not such a number.
    """
    try:
        value = float(text)
    except ValueError:  # argparse's own text: in rosbag2, the type is float
        raise argparse.ArgumentTypeError(f"invalid float value: {text!r}") from None
    if not value <= _MOST_SECONDS:  # not `>`, so that NaN is rejected as well
        raise argparse.ArgumentTypeError(f"{text} is not in the valid range (<= {_MOST_SECONDS})")
    return value


def seconds_from_zero(text: str) -> float:
    """Return a number of seconds from zero that fits into 64 bits of nanoseconds.

    Raises:
        argparse.ArgumentTypeError: The text is not such a number.
    """
    if not number(text) >= 0:
        raise argparse.ArgumentTypeError(f"{text} is not in the valid range (>= 0.0)")
    return seconds(text)


def several(flag: str, what: str, text: str, completer: Completer | None = None) -> Argument:
    """Return an option that takes one or more names, and is empty by default."""
    return argument(flag, metavar=what, nargs="+", default=[], help=text, completer=completer)


def bag_and_storage(words: Sequence[str]) -> tuple[str, str]:
    """Return the path of a bag and its storage, which is empty if it is not given.

    Raises:
        argparse.ArgumentTypeError: The bag does not exist, its storage is not known, or there are
            further words.
    """
    if not 1 <= len(words) <= 2:
        raise argparse.ArgumentTypeError(
            f"expected a bag and optionally its storage, got {len(words)} words"
        )
    storage = words[1] if len(words) == 2 else ""
    if storage and storage not in STORAGES:
        raise argparse.ArgumentTypeError(
            f"invalid storage '{storage}' (choose from {', '.join(STORAGES)})"
        )
    return bag_path(words[0]), storage


class _Input(argparse.Action):
    """Collects ``-i URI [STORAGE_ID]``."""

    def __call__(
        self,
        _parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        _option: str | None = None,
    ) -> None:
        """Check one bag's words."""
        try:
            found = bag_and_storage([str(value) for value in values or ()])
        except argparse.ArgumentTypeError as error:
            raise argparse.ArgumentError(self, str(error)) from None
        known = getattr(namespace, self.dest) or []
        setattr(namespace, self.dest, [*known, found])


INPUT = argument(
    "-i",
    "--input",
    action=_Input,
    nargs="+",
    metavar=("uri", "storage_id"),
    help="A bag to read, and optionally its storage; may be given several times",
    completer=files,
)

#: One bag by its path, or several with ``-i``.
BAGS_TO_PLAY = (
    argument(
        "bag_path",
        nargs="?",
        type=bag_path,
        help="Folder of the bag, or one file",
        completer=files,
    ),
    STORAGE,
    INPUT,
)


def bags_to_play(args: argparse.Namespace) -> list[StorageOptions]:
    """Return the bags of `BAGS_TO_PLAY`; the program ends with its usage if no bag is given."""
    from rosbag2_py import StorageOptions

    found = [StorageOptions(uri=uri, storage_id=storage) for uri, storage in args.input or ()]
    if args.bag_path is not None:
        found.insert(0, StorageOptions(uri=args.bag_path, storage_id=args.storage))
    if not found:
        args.parser.error("the following arguments are required: bag_path, or -i/--input")
    return found


def bag_topics(*, parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """Return the names of the topics in the bag on the command line."""
    from turtlewire.bag import open_bag
    from turtlewire.errors import BagError

    try:
        with open_bag(getattr(parsed_args, "bag_path", None) or "") as bag:
            return sorted(bag.topics)
    except (BagError, OSError):
        return []  # not there yet


def event_topics(services: list[str]) -> list[str]:
    """Return the topics on which the events of services are; ROS 2 needs the slash in front."""
    return [f"{absolute(name)}/_service_event" for name in services]


def absolute(name: str) -> str:
    """Return the name of a topic or service as the graph and bags know it."""
    return name if name.startswith("/") else f"/{name}"


def remap_words(rules: list[str]) -> list[str]:
    """Return remapping rules as words of a command line.

    Raises:
        RuntimeError: A rule has no ``:=``.
    """
    for rule in rules:
        if ":=" not in rule:
            raise RuntimeError(f"'{rule}' is not of the form OLD:=NEW, for example /tf:=/old_tf")
    return ["--ros-args", *(word for rule in rules for word in ("--remap", rule))] if rules else []


def custom_data(text: str) -> tuple[str, str]:
    """Split ``KEY=VALUE`` into two strings.

    Raises:
        argparse.ArgumentTypeError: There is no ``=``.
    """
    key, equals, value = text.partition("=")
    if not (key and equals):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form KEY=VALUE")
    return key, value


def qos_overrides(path: str | None) -> dict[str, QoSProfile]:
    """Return the profiles in a file, by topic; none without a file.

    Raises:
        RuntimeError: The file does not hold profiles.
    """
    if not path:
        return {}
    from rosbag2_transport.qos_overrides import read_qos_overrides

    return read_qos_overrides(path)
