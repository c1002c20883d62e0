"""Options that several verbs of ``ros2 bag`` have."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.completion import files

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile

__all__ = [
    "LOG_LEVEL",
    "QOS_OVERRIDES",
    "STORAGES",
    "custom_data",
    "existing_file",
    "qos_overrides",
]

STORAGES = ("mcap", "sqlite3")

LOG_LEVEL = argument(
    "--log-level",
    choices=("debug", "info", "warn", "error", "fatal"),
    default="info",
    help="The least severe messages that are logged",
)


def existing_file(text: str) -> str:
    """A file that exists.

    Raises:
        argparse.ArgumentTypeError: There is none.
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


def custom_data(text: str) -> tuple[str, str]:
    """``KEY=VALUE`` as two texts.

    Raises:
        argparse.ArgumentTypeError: There is no ``=``.
    """
    key, equals, value = text.partition("=")
    if not (key and equals):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form KEY=VALUE")
    return key, value


def qos_overrides(path: str | None) -> dict[str, QoSProfile]:
    """The profiles in a file, by topic; none without a file.

    Raises:
        RuntimeError: The file does not hold profiles.
    """
    if not path:
        return {}
    from rosbag2_transport.qos_overrides import read_qos_overrides

    return read_qos_overrides(path)
