"""Runs a node until Ctrl-C, as all demos do."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import TYPE_CHECKING

import rclpy
from rclpy.executors import ExternalShutdownException

if TYPE_CHECKING:
    from rclpy.node import Node


def spin(make_node: Callable[[], Node], args: list[str] | None = None) -> None:
    """Initialize rclpy, make the node and spin it until Ctrl-C or a shutdown."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(make_node())
