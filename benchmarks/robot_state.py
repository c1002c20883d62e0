"""robot_state_publisher with 60 moving joints at 500 Hz: CPU for each joint state.

``bytes to bytes`` is the conversion alone; ``node`` is the whole process with the wire, in which
the node's subscription, the conversion and the sending are counted. The rival of the conversion is
its plain-Python twin.
"""

from __future__ import annotations

import contextlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Figure, Row

if TYPE_CHECKING:
    from collections.abc import Iterator

TITLE = "robot_state_publisher: 60 joints, CPU for each joint state"
JOINTS, RATE_HZ, MESSAGES, ROUNDS = 60, 500, 1000, 3
NAMES = [f"joint_{number}" for number in range(JOINTS)]


def rows() -> Iterator[Row]:
    native, plain = convert("native"), convert("python")
    yield Row("bytes to bytes", native, {"plain-Python twin": plain}, "<= 15 us")
    values = [measure() for _ in range(ROUNDS)]
    yield Row("node, at 500 Hz, wire included", Figure(min(values), statistics.median(values)))


def urdf() -> str:
    links = "".join(f'<link name="link_{number}"/>' for number in range(JOINTS))
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="base"/><child link="link_{number}"/>'
        f'<origin xyz="1 2 {number}" rpy="0.1 0.2 {number}"/><axis xyz="1 0.5 0"/></joint>'
        for number, name in enumerate(NAMES)
    )
    return f'<robot name="r"><link name="base"/>{links}{joints}</robot>'


def joint_state(number: int) -> bytes:
    from sensor_msgs.msg import JointState
    from turtlewire.msg import serialize

    message = JointState(name=NAMES, position=[0.001 * number] * JOINTS)
    message.velocity = message.effort = [0.0] * JOINTS
    message.header.stamp.sec, rest = divmod(number, RATE_HZ)
    message.header.stamp.sec += 1
    message.header.stamp.nanosec = rest * (1_000_000_000 // RATE_HZ)
    return serialize(message)


def convert(core: str) -> Figure:
    code = (
        "from benchmarks import robot_state as b; from turtlewire.urdf import parse_urdf\n"
        "from turtlewire.urdf.joint_messages import JointMessages; import time, json\n"
        "m = JointMessages(parse_urdf(b.urdf())); d = [b.joint_state(n) for n in range(2000)]\n"
        "def one():\n"
        "    t = time.process_time_ns()\n"
        "    for cdr in d: m.layout_of(cdr).transforms(cdr)\n"
        "    return (time.process_time_ns() - t) / len(d)\n"
        "one(); print(json.dumps([one() for _ in range(15)]))"
    )
    environment = {**os.environ, "TURTLEWIRE_CORE": core}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    values = json.loads(done.stdout)
    return Figure(min(values), statistics.median(values))


def measure() -> float:
    """CPU nanoseconds of the node's process for each joint state; all are published."""
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": "103",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    command = [sys.executable, "-m", __name__]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.urdf"
        path.write_text(urdf())
        with (
            subprocess.Popen(
                [*command, "receive", str(path)], env=environment, stdout=subprocess.PIPE, text=True
            ) as receiver,
            subprocess.Popen([*command, "send"], env=environment) as sender,
        ):
            output, _ = receiver.communicate(timeout=60)
            sender.kill()
    return float(output)


def receive(path: str) -> None:
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from robot_state_publisher import RobotStatePublisher

    rclpy.init(args=["x", "--ros-args", "-p", "ignore_timestamp:=true", "--log-level", "error"])
    node = RobotStatePublisher(urdf_file=path)
    (subscription,) = (each for each in node.subscriptions if each.topic == "/joint_states")
    handle, count, start = subscription.callback, 0, 0

    def counting(cdr: bytes) -> None:
        nonlocal count, start
        handle(cdr)
        count += 1
        if count == 200:
            start = time.process_time_ns()

    subscription.callback = counting
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while count < 200 + MESSAGES:
        executor.spin_once()
    print((time.process_time_ns() - start) / (count - 200))


def send() -> None:
    import rclpy
    from sensor_msgs.msg import JointState
    from tf2_msgs.msg import TFMessage

    rclpy.init(args=[])
    node = rclpy.create_node("sender")
    publisher = node.create_publisher(JointState, "/joint_states", 10)
    node.create_subscription(TFMessage, "/tf", lambda _: None, 10, raw=True)
    begin, number = time.monotonic(), 0
    with contextlib.suppress(KeyboardInterrupt):
        while rclpy.ok():
            publisher.publish(joint_state(number))
            number += 1
            time.sleep(max(0.0, begin + number / RATE_HZ - time.monotonic()))


if __name__ == "__main__":
    receive(sys.argv[2]) if sys.argv[1] == "receive" else send()
