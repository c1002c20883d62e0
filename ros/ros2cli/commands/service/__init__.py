"""``ros2 service``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

__all__ = ["VERBS", "add_arguments"]

VERBS = {
    "call": "Call a service",
    "echo": "Print the requests and responses of a service that has introspection on",
    "find": "List the services of a type",
    "info": "Show how many offer and may call a service",
    "list": "List the services",
    "type": "Show the type of a service",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define what all verbs share."""
    parser.add_argument(
        "--include-hidden-services",
        action="store_true",
        help="Also services with a part that begins with an underscore",
    )
