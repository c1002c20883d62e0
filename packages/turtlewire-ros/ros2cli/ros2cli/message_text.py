"""Formats messages as text, with the options of the verbs ``echo``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.arguments import argument, unsigned_int

DEFAULT_TRUNCATE_LENGTH = 128

TEXT_ARGUMENTS = (
    argument(
        "--csv", action="store_true", help="One line of comma-separated values for each message"
    ),
    argument("-f", "--full-length", action="store_true", help="Do not shorten arrays and strings"),
    argument(
        "-l",
        "--truncate-length",
        type=unsigned_int,
        default=DEFAULT_TRUNCATE_LENGTH,
        help="Length to which arrays and strings are shortened",
    ),
    argument("--no-arr", action="store_true", help="Show only the types of arrays"),
    argument("--no-str", action="store_true", help="Show only the lengths of strings"),
    argument("--flow-style", action="store_true", help="Write sequences on one line"),
)


def message_csv(message: Any, args: argparse.Namespace) -> str:
    """Return a message as one line of comma-separated values."""
    from rosidl_runtime_py import message_to_csv

    return message_to_csv(
        message, truncate_length=_length(args), no_arr=args.no_arr, no_str=args.no_str
    )


def message_yaml(message: Any, args: argparse.Namespace) -> str:
    """Return a message as YAML that ends with a line feed."""
    from rosidl_runtime_py import message_to_yaml

    return message_to_yaml(
        message,
        truncate_length=_length(args),
        no_arr=args.no_arr,
        no_str=args.no_str,
        flow_style=args.flow_style,
    )


def message_text(message: Any, args: argparse.Namespace) -> str:
    """Return a message as the options want it: as CSV, or as YAML before a line ``---``."""
    return message_csv(message, args) if args.csv else f"{message_yaml(message, args)}---"


def event_text(event: Any, args: argparse.Namespace) -> str:
    """Return `message_text` of a service event; in YAML, the type of the event is a word."""
    from rclpy.service_introspection import EventType

    text = message_text(event, args)
    number = event.info.event_type
    if number in list(EventType):  # a peer may send any number
        text = text.replace(f"event_type: {number}\n", f"event_type: {EventType(number).name}\n", 1)
    return text


def _length(args: argparse.Namespace) -> int | None:
    return None if args.full_length else args.truncate_length
