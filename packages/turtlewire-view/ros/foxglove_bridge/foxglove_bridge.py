"""``ros2 run foxglove_bridge foxglove_bridge``: the node, with the names of ROS 2's parameters."""

from __future__ import annotations

import contextlib
import sys
from typing import Any

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.utilities import remove_ros_args
from turtlewire_ros.prefix import share_directory
from turtlewire_view.foxglove import BridgeOptions, FoxgloveServer

__all__ = ["FoxgloveBridge", "main"]

_USAGE = """usage: foxglove_bridge [--ros-args -p port:=8765 ...]

Serves topics, services and parameters to Foxglove and Lichtblick over a WebSocket.

parameters: port                    TCP port (default 8765; 0: a free one)
            address                 where to listen (default 127.0.0.1, this machine only)
            topic_whitelist         regular expressions of topics (default all)
            service_whitelist       regular expressions of services (default all)
            param_whitelist         regular expressions of parameters, /node.name (default all)
            client_topic_whitelist  regular expressions of topics that clients may publish on
            capabilities            what clients are offered (default all)
            asset_uri_allowlist     regular expressions of package:// files that clients may read
            send_buffer_limit       bytes that may wait for a slow client (default 10000000)
            include_hidden          offer hidden topics and services (default false)
            use_sim_time            take the time from /clock, and send it (default false)
            origins                 further web pages that may connect (default none)"""

#: Parameters of ROS 2's node that say how it works inside, with their defaults.
_WITHOUT_EFFECT = {
    "num_threads": 0,
    "min_qos_depth": 1,
    "max_qos_depth": 25,
    "best_effort_qos_topic_whitelist": ["(?!)"],
    "use_compression": False,
    "ignore_unresponsive_param_nodes": True,
    "publish_client_count": False,
    "disable_load_message": True,
}
_FIXED = ParameterDescriptor(read_only=True)


class FoxgloveBridge(Node):
    """The node: it serves as long as it exists.

    Args:
        **options: As for :class:`rclpy.node.Node`.

    Attributes:
        url: Where clients connect.

    Raises:
        ValueError: A parameter is out of its range, or asks for what does not exist here.
        OSError: The address or port cannot be used.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__("foxglove_bridge", **options)
        try:
            wanted = self._options()
            self._server = FoxgloveServer(
                self.context.wire,
                self._rclpy_wire,
                wanted,
                self.get_logger(),
                share_directory,
            )
        except BaseException:
            super().destroy_node()
            raise
        self.url = self._server.url
        self.get_logger().info(f"Foxglove and Lichtblick connect to {self.url}")
        if not wanted.is_local:
            self.get_logger().warning(wanted.warning)

    def destroy_node(self) -> None:
        """Close all connections, then leave the graph."""
        self._server.close()
        super().destroy_node()

    def _options(self) -> BridgeOptions:
        """Return the settings, from parameters of the same names."""
        values: dict[str, Any] = {}
        for name, default in vars(BridgeOptions()).items():
            if name == "use_sim_time":  # each node has it
                values[name] = self.get_parameter(name).value
            elif isinstance(default, tuple):  # a launch file cannot pass an empty list
                given = self.declare_parameter(name, [*default] or [""], _FIXED).value
                values[name] = tuple(text for text in given or () if text)
            else:
                values[name] = self.declare_parameter(name, default, _FIXED).value
        self._refuse_tls()
        self._tell_what_has_no_effect()
        return BridgeOptions(**values)

    def _refuse_tls(self) -> None:
        if self.declare_parameter("tls", False, _FIXED).value:
            raise ValueError(
                "tls is not supported; `ssh -L 8765:localhost:8765 ROBOT` also encrypts"
            )

    def _tell_what_has_no_effect(self) -> None:
        idle = [
            name
            for name, default in _WITHOUT_EFFECT.items()
            if self.declare_parameter(name, default, _FIXED).value != default
        ]
        if idle:
            self.get_logger().info(f"Parameters without effect here: {', '.join(idle)}")


def main(args: list[str] | None = None) -> int:
    """Serve until stopped; the exit status."""
    argv = sys.argv if args is None else args
    if {"-h", "--help"} & {*remove_ros_args(argv)[1:]}:
        print(_USAGE)  # noqa: T201
        return 0
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=argv):
        try:
            node = FoxgloveBridge()
        except ValueError as error:
            print(f"foxglove_bridge: {error}", file=sys.stderr)  # noqa: T201
            return 1
        except OSError as error:
            print(f"foxglove_bridge: {error}", file=sys.stderr)  # noqa: T201
            print("    The parameter port sets another port, 0 a free port.", file=sys.stderr)  # noqa: T201
            return 1
        try:
            rclpy.spin(node)
        finally:
            node.destroy_node()
    return 0
