"""Values on the command line of ``ros2 bag``, and QoS profiles of topics."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ros2bag import options as bag_options
from ros2bag.options import STORAGES

if TYPE_CHECKING:
    from rclpy.duration import Duration
    from rclpy.qos import QoSProfile
    from rosbag2_py import StorageOptions

_SPLIT = "SPLIT|"


class SplitLineFormatter(argparse.HelpFormatter):
    """Keeps the lines of a help text that begins with ``SPLIT|``."""

    def _split_lines(self, text: str, width: int) -> list[str]:
        if text.startswith(_SPLIT):
            return text[len(_SPLIT) :].splitlines()
        return super()._split_lines(text, width)


def print_error(string: str) -> str:
    """Return the text as an error of ``ros2 bag``."""
    return f"[ERROR] [ros2bag]: {string}"


def print_warn(string: str) -> str:
    """Return the text as a warning of ``ros2 bag``."""
    return f"[WARN] [ros2bag]: {string}"


def add_standard_reader_args(parser: argparse.ArgumentParser) -> None:
    """Add the path of a bag and ``--storage``."""
    from ros2cli.arguments import add_arguments

    add_arguments(parser, [bag_options.BAG_PATH, bag_options.STORAGE])


def add_standard_multi_reader_args(parser: argparse.ArgumentParser) -> None:
    """Add the path of a bag and ``--storage``, both optional, and ``--input`` for several bags."""
    from ros2cli.arguments import add_arguments

    add_arguments(parser, bag_options.BAGS_TO_PLAY)


def add_multi_bag_input_arg(parser: argparse.ArgumentParser, required: bool = False) -> None:
    """Add ``--input``, whose value is a list of bags, each with its path and storage."""
    options = {**bag_options.INPUT.options, "required": required}
    parser.add_argument(*bag_options.INPUT.names, **options)


def input_bag_arg_to_storage_options(
    input_arg: Sequence[Sequence[str]] | None = None, storage_config_file: str | None = None
) -> list[StorageOptions]:
    """Return the options of bags that ``--input`` names.

    Args:
        input_arg: For each bag its path, and optionally its storage.
        storage_config_file: A file with settings of the storage.

    Raises:
        ValueError: A bag does not exist, its storage is not known, or there are further words.
    """
    from rosbag2_py import StorageOptions

    found = []
    for words in input_arg or ():
        try:
            uri, storage = bag_options.bag_and_storage(words)
        except argparse.ArgumentTypeError as error:
            raise ValueError(print_error(str(error))) from None
        config = storage_config_file or ""
        found.append(StorageOptions(uri=uri, storage_id=storage, storage_config_uri=config))
    return found


def add_writer_storage_plugin_extensions(parser: argparse.ArgumentParser) -> None:
    """Add ``--storage``, by default MCAP."""
    parser.add_argument(
        "-s", "--storage", choices=STORAGES, default="mcap", help="How the bag is stored"
    )


def check_path_exists(value: str) -> str:
    """Return a path that exists, for argparse.

    Raises:
        ArgumentTypeError: The path does not exist.
    """
    return bag_options.bag_path(value)


def check_positive_float(value: str) -> float:
    """Return a number above zero, for argparse.

    Raises:
        ArgumentTypeError: The string is not such a number.
    """
    number: float = _number(float, value)
    if not number > 0:
        raise argparse.ArgumentTypeError(f"{value} is not in the valid range (> 0.0)")
    return number


def check_not_negative_float(value: str) -> float:
    """Return a number from zero, for argparse.

    Raises:
        ArgumentTypeError: The string is not such a number.
    """
    number: float = _number(float, value)
    if not number >= 0:
        raise argparse.ArgumentTypeError(f"{value} is not in the valid range (>= 0.0)")
    return number


def check_not_negative_int(arg: str) -> int:
    """Return a whole number from zero, for argparse.

    Raises:
        ArgumentTypeError: The string is not such a number.
    """
    number: int = _number(int, arg)
    if number < 0:
        raise argparse.ArgumentTypeError(f"{arg} is not in the valid range (>= 0)")
    return number


def _number(kind: Any, text: str) -> Any:
    try:
        return kind(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text} is not the valid type ({kind.__name__})"
        ) from None


def convert_service_to_service_event_topic(services: Sequence[str] | None) -> list[str]:
    """Return the topics on which the events of services are."""
    return bag_options.event_topics(list(services or ()))


def dict_to_duration(time_dict: Mapping[str, int] | None) -> Duration:
    """Return a duration of ``sec`` and ``nsec``; zero for None.

    Raises:
        ValueError: A key is missing.
    """
    from rclpy.duration import Duration

    if not time_dict:
        return Duration()
    try:
        return Duration(seconds=time_dict["sec"], nanoseconds=time_dict["nsec"])
    except KeyError:
        raise ValueError("Time overrides must include both seconds and nanoseconds.") from None


def interpret_dict_as_qos_profile(qos_profile_dict: dict[str, Any]) -> QoSProfile:
    """Return a profile from the words of YAML.

    Raises:
        ValueError: A key or a word is not known.
    """
    from rosbag2_transport.qos_overrides import qos_profile

    try:
        return qos_profile("profile", qos_profile_dict)
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def convert_yaml_to_qos_profile(qos_profile_dict: dict[str, Any]) -> dict[str, QoSProfile]:
    """Return the profiles by topic from the words of YAML.

    Raises:
        ValueError: A key or a word is not known.
    """
    return {
        topic: interpret_dict_as_qos_profile(profile) for topic, profile in qos_profile_dict.items()
    }


def create_bag_directory(uri: str) -> str | None:
    """Make the folder of a bag; returns the text of an error, or None."""
    try:
        os.makedirs(uri)
    except OSError:
        return print_error(f"Could not create bag folder '{uri}'.")
    return None
