"""`ros2 run tf2_ros buffer_server`: receives all transforms, and answers others' lookups."""

from __future__ import annotations

import sys

import rclpy
from rclpy.duration import Duration
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from .buffer import Buffer
from .buffer_server import BufferServer
from .transform_listener import TransformListener

_MOST_S = 1e9


def main(args: list[str] | None = None) -> int:
    """Serve until stopped; return the exit status.

    The parameter ``buffer_size`` says how many seconds of samples are kept; its default is 120.
    """
    rclpy.init(args=args)
    try:
        node = Node("tf_buffer")
        buffer = Buffer(_buffer_size(node), node)
        TransformListener(buffer, node)
        server = BufferServer(buffer, node, "tf2_buffer_server")
        rclpy.spin(node)
        server.destroy()
    except (InvalidParameterTypeException, _BufferSizeError) as error:
        lines = filter(None, (str(error), getattr(error, "hint", "")))
        print("\n".join(lines), file=sys.stderr)  # noqa: T201
        return 1
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0


class _BufferSizeError(Exception):
    pass


def _buffer_size(node: Node) -> Duration:
    size = node.declare_parameter("buffer_size", 120.0).value
    if not 0.0 <= size <= _MOST_S:
        raise _BufferSizeError(f"buffer_size is {size}; it can be 0 to {_MOST_S:.0f} seconds")
    return Duration(seconds=size)
