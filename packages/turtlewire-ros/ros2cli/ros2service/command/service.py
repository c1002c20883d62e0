"""``ros2 service``."""

from __future__ import annotations

from ros2cli.listing import hidden_argument

__all__ = ["ARGUMENTS", "VERBS"]

VERBS = {
    "call": "Call a service",
    "echo": "Print the requests and responses of a service that has introspection on",
    "find": "List the services of a type",
    "info": "Show how many offer and may call a service",
    "list": "List the services",
    "type": "Show the type of a service",
}


ARGUMENTS = (hidden_argument("service"),)
