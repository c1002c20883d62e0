"""Executables, and a node that subscribes to topics."""

from __future__ import annotations

import threading

import pytest
from tests.places import ROS2

import rclpy
from rclpy.executors import SingleThreadedExecutor


class Heard:
    """The messages of one topic."""

    def __init__(self, node, message_type, topic):
        self.got = []
        self._more = threading.Condition()
        node.create_subscription(message_type, topic, self._take, 100)

    def _take(self, message):
        with self._more:
            self.got.append(message)
            self._more.notify_all()

    def wait_until(self, is_done, timeout=60):
        """Wait until the messages satisfy a condition; return False after the timeout."""
        with self._more:
            return self._more.wait_for(lambda: is_done(self.got), timeout)


@pytest.fixture
def start(run):
    """Starts executables, each in its own process."""

    def start(package: str, executable: str, *arguments: str, **options):
        return run(ROS2, "run", package, executable, *arguments, **options)

    return start


@pytest.fixture
def listening():
    """Subscribes to topics, in a thread that spins."""
    with rclpy.init():
        node = rclpy.create_node("listening")
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin)
        thread.start()
        yield lambda message_type, topic: Heard(node, message_type, topic)
        executor.shutdown()
        thread.join()
        node.destroy_node()
