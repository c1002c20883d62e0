"""Changes the level of a node's logger through the node's services, and logs at each level."""

from __future__ import annotations

import threading
from typing import Any

import rclpy
from rcl_interfaces.msg import LoggerLevel
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

_LEVELS = {
    "debug": LoggerLevel.LOG_LEVEL_DEBUG,
    "info": LoggerLevel.LOG_LEVEL_INFO,
    "warn": LoggerLevel.LOG_LEVEL_WARN,
    "error": LoggerLevel.LOG_LEVEL_ERROR,
}


class LoggerServiceNode(Node):
    """Logs messages on ``output`` at four levels; its logger's level can be set."""

    def __init__(self) -> None:
        super().__init__("LoggerServiceNode", enable_logger_service=True)
        self.sub = self.create_subscription(String, "output", self.callback, 10)
        self.heard = threading.Semaphore(0)

    def callback(self, message: String) -> None:
        """Log one message at each level."""
        logger = self.get_logger()
        logger.debug(f"{message.data} with DEBUG logger level.")
        logger.info(f"{message.data} with INFO logger level.")
        logger.warning(f"{message.data} with WARN logger level.")
        logger.error(f"{message.data} with ERROR logger level.")
        self.heard.release()


class TestNode(Node):
    """Publishes messages to log, and sets the level at which they are logged.

    Args:
        remote_node: Name of the node with the logger.
    """

    def __init__(self, remote_node: str) -> None:
        super().__init__("TestNode")
        self.pub = self.create_publisher(String, "output", 10)
        self._remote_node = remote_node
        self._get = self.create_client(GetLoggerLevels, f"{remote_node}/get_logger_levels")
        self._set = self.create_client(SetLoggerLevels, f"{remote_node}/set_logger_levels")

    def set_logger_level(self, level: int) -> bool:
        """Return True if the level was set."""
        request = SetLoggerLevels.Request()
        request.levels = [LoggerLevel(name=self._remote_node, level=level)]
        results = self._ask(self._set, request).results
        return bool(results and results[0].successful)

    def get_logger_level(self) -> int:
        """Return the level now."""
        request = GetLoggerLevels.Request(names=[self._remote_node])
        level: int = self._ask(self._get, request).levels[0].level
        return level

    def _ask(self, client: Any, request: Any) -> Any:
        client.wait_for_service()
        future = client.call_async(request)
        rclpy.spin_until_future_complete(self, future)
        return future.result()


def main(args: list[str] | None = None) -> None:
    """Log at the default level, and after setting the levels one by one."""
    with rclpy.init(args=args):
        logging, test = LoggerServiceNode(), TestNode("LoggerServiceNode")
        executor = SingleThreadedExecutor()
        # Only this node: `TestNode` spins itself while it waits for a response.
        executor.add_node(logging)
        thread = threading.Thread(target=executor.spin, daemon=True)
        thread.start()
        _log(test, logging, 1, "default")
        for number, (name, level) in enumerate(_LEVELS.items(), start=2):
            if test.set_logger_level(level) and test.get_logger_level() == level:
                _log(test, logging, number, name)
            else:
                test.get_logger().error(f"Failed to set the logger level {name}.")
        executor.shutdown()
        thread.join()


def _log(test: TestNode, logging: LoggerServiceNode, number: int, level: str) -> None:
    test.get_logger().info(f"Output with {level} logger level:")
    test.pub.publish(String(data=f"Output {number}"))
    # Otherwise the next level could be set before this message is logged.
    logging.heard.acquire()
