"""Programs with type hints, checked by a type checker."""

import os
import subprocess
import sys

import pytest
from tests.places import IMPORT_PATH

PROGRAM = """
import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.duration import Duration
from rclpy.experimental import AsyncNode
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.client import Client
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.task import Future
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
        self.typed: Publisher[String] = self.create_publisher(String, "chatter", 10)
        self.plain: Publisher = self.typed
        self.raw = self.create_subscription(String, "chatter", self.heard_raw, 10, raw=True)
        self.client: Client[AddTwoInts] = self.create_client(AddTwoInts, "add")
        self.speed: float = self.declare_parameter("speed", 1.0).value
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)

    def tick(self) -> None:
        self.publisher_.publish(String(data="x"))
        try:
            there = self.buffer.lookup_transform("a", "b", Time(), timeout=Duration(seconds=1))
            self.get_logger().info(f"{there.transform.translation.x + 1.0}")
            self.get_logger().info(rclpy.get_rmw_implementation_identifier())
        except TransformException as error:
            self.get_logger().info(str(error), throttle_duration_sec=1.0)

    def heard_raw(self, cdr: bytes) -> None:
        self.typed.publish(cdr)

    def ask(self) -> Future[AddTwoInts.Response]:
        return self.client.call_async(AddTwoInts.Request(a=1, b=2))

    def heard(self, message: String) -> None:
        self.get_logger().info(message.data)

    def add(
        self, request: AddTwoInts.Request, response: AddTwoInts.Response
    ) -> AddTwoInts.Response:
        response.sum = request.a + request.b
        return response


class Managed(LifecycleNode):
    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        return TransitionCallbackReturn.SUCCESS


async def answer(
    request: AddTwoInts.Request, response: AddTwoInts.Response
) -> AddTwoInts.Response:
    return response


async def ask() -> str:
    async with AsyncNode("asking") as node:
        node.create_service(AddTwoInts, "add", answer)
        client = node.create_client(AddTwoInts, "add")
        await client.wait_for_service()
        response = await client.call(AddTwoInts.Request(a=1, b=2))
        number: int = response.sum
        buffer = Buffer()
        TransformListener(buffer, node)
        await buffer.lookup_transform_async("a", "b", Time())
        async for message in node.create_subscription(String, "chatter", None, 10):
            return f"{number} {message.data}"
    return ""


def main() -> None:
    rclpy.init()
    node = Talker()
    rclpy.spin(node)
    node.destroy_node()
    rclpy.shutdown()
"""

MISTAKES = """
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import PointStamped
from message_filters import Cache, Subscriber
from rclpy.action import ActionClient
from rclpy.experimental import AsyncNode
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import String

Node("a", namspace="/b")
Node("a").create_timer("1.0", print)
String().dta
node = Node("a")
node.create_publisher(String, "a", 1).publish(3)
def heard(number: int) -> None: ...
node.create_subscription(String, "a", heard, 1)
QoSProfile(depht=1)
client = node.create_client(AddTwoInts, "add")
client.call_async(String())
client.call(AddTwoInts.Request()).som
ActionClient(node, Fibonacci, "count").send_goal_async(AddTwoInts.Request())
Future[int]().set_result("1")
client.call(AddTwoInts.Request(), 1.0).sum
points = Subscriber(node, PointStamped, "points")
points.registerCallback(heard)
points.registerCallback(print, "further", "arguments")
Cache(points).getInterval(Time(), Time())[0].pint
asynchronous = AsyncNode("b")
asynchronous.create_subscription(String, "a", heard, 1)
asynchronous.create_rate(1.0)
async def ask() -> None:
    (await asynchronous.create_client(AddTwoInts, "add").call(AddTwoInts.Request())).som
"""
MISTAKEN_LINES = [14, 15, 16, 18, 20, 21, 23, 24, 25, 26, 27, 29, 31, 33, 34, 36]


@pytest.mark.slow
def test_a_strict_type_checker_accepts_programs_and_finds_mistakes(tmp_path):
    pytest.importorskip("mypy", reason="needs mypy (scripts/setup lint)")
    (tmp_path / "user.py").write_text(PROGRAM)
    (tmp_path / "wrong.py").write_text(MISTAKES)
    environment = {**os.environ, "MYPYPATH": ":".join(map(str, IMPORT_PATH))}
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
        timeout=840,
    )
    errors = [line.partition(" ")[0] for line in done.stdout.splitlines() if ": error: " in line]
    assert errors == [f"wrong.py:{line}:" for line in MISTAKEN_LINES], done.stdout
