"""The class of ``ros2 service call``."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.builtin import BuiltinVerb
from ros2cli.commands.service.call import main
from ros2cli.node import NODE_NAME_PREFIX
from ros2service.verb import VerbExtension

__all__ = ["NODE_NAME_PREFIX", "CallVerb", "requester"]


class CallVerb(BuiltinVerb, VerbExtension):
    """Call a service."""

    _module = "service.call"


def requester(service_type: str, service_name: str, values: str, period: float | None) -> Any:
    """Call a service, and print the response.

    Args:
        service_type: Its type, for example ``turtlesim/srv/Spawn``.
        service_name: Its name.
        values: Values of the request as YAML.
        period: Seconds between calls; None calls once.

    Returns:
        The text of an error, or None.
    """
    rate = None if period is None else 1.0 / period
    return main(
        argparse.Namespace(
            service_type=service_type,
            service_name=service_name,
            values=values,
            stdin=False,
            rate=rate,
        )
    )
