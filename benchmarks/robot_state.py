"""robot_state_publisher with 60 moving joints at 500 Hz: CPU for each joint state.

``bytes to bytes`` is the conversion alone; ``node`` is the whole process with the wire, in which
the node's subscription, the conversion and the sending are counted. The rival of the conversion is
its plain-Python version. The rival of the node is a process that only answers datagrams of the
same sizes, with two system calls each: the share of the operating system in the node's time.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.figures import Figure, Row, on_loopback, printed
from turtlewire.urdf import Robot
from turtlewire.urdf.joint_messages import JointMessages

TITLE = "robot_state_publisher: 60 joints, CPU for each joint state"
JOINTS, RATE_HZ, WARM_UP, MESSAGES, ROUNDS = 60, 500, 200, 1000, 3
NAMES = [f"joint_{number}" for number in range(JOINTS)]


def rows() -> Iterator[Row]:
    native, plain = convert("native"), convert("python")
    yield Row("bytes to bytes", native, {"plain-Python twin": plain}, "<= 15 us")
    figure = Figure.of([measure() for _ in range(ROUNDS)])
    rival = {"bare datagrams": Figure.of([answer_datagrams() for _ in range(ROUNDS)])}
    yield Row("node, at 500 Hz, wire included", figure, rival, "<= 15 us")


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
        "from benchmarks import robot_state as b; from turtlewire.urdf import Robot\n"
        "from turtlewire.urdf.joint_messages import JointMessages; import time, json\n"
        "m = JointMessages(Robot.from_xml(b.urdf())); d = [b.joint_state(n) for n in range(2000)]\n"
        "def one():\n"
        "    t = time.process_time_ns()\n"
        "    for cdr in d: m.layout_of(cdr).transforms(cdr)\n"
        "    return (time.process_time_ns() - t) / len(d)\n"
        "one(); print(json.dumps([one() for _ in range(15)]))"
    )
    environment = {**os.environ, "TURTLEWIRE_CORE": core}
    return Figure.of(printed([sys.executable, "-c", code], environment))


def answer_datagrams() -> float:
    """CPU nanoseconds of a process for each datagram that it receives and answers."""
    size = len(
        JointMessages(Robot.from_xml(urdf())).layout_of(joint_state(0)).transforms(joint_state(0))
    )
    code = (
        "import socket, time; s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n"
        f"s.bind(('127.0.0.1', 0)); print(s.getsockname()[1], flush=True); out = bytes({size})\n"
        f"for n in range({WARM_UP + MESSAGES}):\n"
        f"    if n == {WARM_UP}: t = time.process_time_ns()\n"
        "    _, sender = s.recvfrom(65536); s.sendto(out, sender)\n"
        f"print((time.process_time_ns() - t) / {MESSAGES})"
    )
    command = [sys.executable, "-c", code]
    with (
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
    ):
        assert process.stdout is not None
        sender.connect(("127.0.0.1", int(process.stdout.readline())))
        begin = time.monotonic()
        for number in range(WARM_UP + MESSAGES):
            sender.send(joint_state(number))
            sender.recv(65536)
            time.sleep(max(0.0, begin + (number + 1) / RATE_HZ - time.monotonic()))
        return float(process.stdout.read())


def measure() -> float:
    """CPU nanoseconds of the node's process for each joint state; all are published."""
    environment = on_loopback(103)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.urdf"
        path.write_text(urdf())
        module = "from robot_state_publisher.robot_state_publisher import main; main()"
        options = ["--ros-args", "-p", "ignore_timestamp:=true", "--log-level", "error"]
        with subprocess.Popen(
            [sys.executable, "-c", module, str(path), *options], env=environment
        ) as node:
            command = [sys.executable, "-m", __name__, str(node.pid)]
            cost = printed(command, environment, 60)
            node.terminate()
    return cost


def send(pid: int) -> None:
    """Send joint states to the node, and print its CPU nanoseconds for each."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from sensor_msgs.msg import JointState
    from tf2_msgs.msg import TFMessage

    rclpy.init(args=[])
    node = rclpy.create_node("sender")
    publisher = node.create_publisher(JointState, "/joint_states", 10)
    answers = 0

    def count(_cdr: bytes) -> None:
        nonlocal answers
        answers += 1

    node.create_subscription(TFMessage, "/tf", count, 1000, raw=True)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    while not answers and rclpy.ok():  # until both know each other
        publisher.publish(joint_state(0))
        executor.spin_once(timeout_sec=0.1)
    cpu_clock = (~pid << 3) | 2  # of another process: clock_getcpuclockid(3)
    answers, begin, number, start = 0, time.monotonic(), 0, 0
    while number < WARM_UP + MESSAGES and rclpy.ok():
        if number == WARM_UP:
            answers, start = 0, time.clock_gettime_ns(cpu_clock)
        publisher.publish(joint_state(number))
        number += 1
        while (left := begin + number / RATE_HZ - time.monotonic()) > 0:
            executor.spin_once(timeout_sec=left)
    print((time.clock_gettime_ns(cpu_clock) - start) / max(1, answers))


if __name__ == "__main__":
    send(int(sys.argv[1]))
