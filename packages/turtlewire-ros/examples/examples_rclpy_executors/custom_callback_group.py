"""A callback group of our own: it lets its callbacks run once in a while only."""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.callback_groups import CallbackGroup
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import String

if TYPE_CHECKING:
    from rclpy.timer import Timer


class ThrottledCallbackGroup(CallbackGroup):
    """Runs one callback, then none until a timer allows the next one.

    Args:
        node: Has the timer, which is in the node's default group.
        period: Seconds between two callbacks.
    """

    def __init__(self, node: Node, period: float = 0.5) -> None:
        super().__init__()
        self.timer: Timer = node.create_timer(period, self.timer_callback)
        self.bucket = 10
        self.bucket_max = 10
        self.lock = threading.Lock()

    def can_execute(self, entity: Any) -> bool:  # noqa: ARG002 -- all are alike
        """Return True if a callback may run now."""
        return self.bucket > 0

    def beginning_execution(self, entity: Any) -> bool:  # noqa: ARG002 -- all are alike
        """Take a turn, if there is one."""
        # Several threads of an executor may call this at once.
        with self.lock:
            if self.bucket > 0:
                self.bucket -= 1
                return True
        return False

    def ending_execution(self, entity: Any) -> None:
        """Do nothing: only the timer refills the bucket."""

    def timer_callback(self) -> None:
        """Allow as many callbacks as before."""
        with self.lock:
            self.bucket = self.bucket_max


class IntermittentTalker(Node):
    """Publishes ten greetings in a burst every few seconds.

    Its timer would publish many more, but its group lets ten of them run in each period.
    """

    def __init__(self) -> None:
        super().__init__("intermittent_talker")
        self.i = 0
        self.group = ThrottledCallbackGroup(self, 2.0)
        self.pub = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.1, self.timer_callback, callback_group=self.group)

    def timer_callback(self) -> None:
        """Publish one greeting."""
        message = String(data=f"Hello World: {self.i}")
        self.i += 1
        self.get_logger().info(f'Publishing: "{message.data}"')
        self.pub.publish(message)


def main(args: list[str] | None = None) -> None:
    """Talk until Ctrl-C."""
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException), rclpy.init(args=args):
        rclpy.spin(IntermittentTalker())
