"""`ros2 run tf2_ros buffer_server`: one process listens to all transforms and answers the lookups of others."""

from __future__ import annotations

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from .buffer import Buffer
from .buffer_server import BufferServer
from .transform_listener import TransformListener

__all__ = ["main"]


def main(args: list[str] | None = None) -> int:
    """Serve until stopped; the exit status. The parameter ``buffer_size`` says how many seconds are kept, 120 unless set."""
    rclpy.init(args=args)
    try:
        node = Node("tf_buffer")
        buffer = Buffer(Duration(seconds=node.declare_parameter("buffer_size", 120.0).value), node)
        TransformListener(buffer, node)
        server = BufferServer(buffer, node, "tf2_buffer_server")
        rclpy.spin(node)
        server.destroy()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0
