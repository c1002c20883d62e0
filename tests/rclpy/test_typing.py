"""Programs with type hints: what a type checker says of them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

PROGRAM = """
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.duration import Duration
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from std_msgs.msg import String
from tf2_ros import Buffer, TransformException, TransformListener


class Talker(Node):
    def __init__(self) -> None:
        super().__init__("talker")
        self.publisher_ = self.create_publisher(String, "chatter", 10)
        self.timer = self.create_timer(0.5, self.tick)
        quality = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.subscription = self.create_subscription(String, "chatter", self.heard, quality)
        self.service = self.create_service(AddTwoInts, "add", self.add)
        self.speed: float = self.declare_parameter("speed", 1.0).value
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)

    def tick(self) -> None:
        self.publisher_.publish(String(data="x"))
        try:
            there = self.buffer.lookup_transform("a", "b", Time(), timeout=Duration(seconds=1))
            self.get_logger().info(f"{there.transform.translation.x + 1.0}")
        except TransformException as error:
            self.get_logger().info(str(error), throttle_duration_sec=1.0)

    def heard(self, message: String) -> None:
        self.get_logger().info(message.data)

    def add(self, request: AddTwoInts.Request, response: AddTwoInts.Response) -> AddTwoInts.Response:
        response.sum = request.a + request.b
        return response


class Managed(LifecycleNode):
    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.SUCCESS


def main() -> None:
    rclpy.init()
    node = Talker()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()
"""

MISTAKES = """
from rclpy.node import Node
from std_msgs.msg import String

Node("a", namspace="/b")
Node("a").create_timer("1.0", print)
String().dta
"""


@pytest.mark.slow
def test_a_strict_type_checker_accepts_programs_and_finds_mistakes(tmp_path):
    pytest.importorskip("mypy", reason="the type checker comes with the lint group")
    (tmp_path / "user.py").write_text(PROGRAM)
    (tmp_path / "wrong.py").write_text(MISTAKES)
    environment = {**os.environ, "MYPYPATH": f"{ROOT / 'src'}:{ROOT / 'ros'}"}
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--cache-dir",
        str(tmp_path / "cache"),
        "user.py",
        "wrong.py",
    ]
    done = subprocess.run(
        command,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        timeout=110,
    )
    errors = [line.partition(" ")[0] for line in done.stdout.splitlines() if ": error: " in line]
    assert errors == ["wrong.py:5:", "wrong.py:6:", "wrong.py:7:"], done.stdout
