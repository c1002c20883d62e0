"""Peers that send nonsense, stop in the middle or connect and stay silent."""

import os
import random
import re
import signal
import socket
import struct
import sys
import urllib.request
from pathlib import Path

import pytest
from tests.places import ROS2

pytestmark = pytest.mark.slow

DATAGRAMS = 20_000
#: Submessages of RTPS: data, fragments, heartbeats, gaps, acknowledgements, times, and unknown
#: ones.
KINDS = [0x01, 0x06, 0x07, 0x08, 0x09, 0x0C, 0x0D, 0x0E, 0x0F, 0x12, 0x13, 0x15, 0x16, 0x80, 0xFF]

#: Prints what it hears on /words, until told to end. The topic is latched: who speaks ends at once,
#: and may know the listener before the listener knows who speaks.
LISTENER = """
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("listener")
latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
node.create_subscription(String, "words", lambda message: print("heard", message.data), latched)
print("up")
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    print("interrupted")
"""
#: Publishes large reliable messages to a reader that has stopped, then ends.
TALKER = """
import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
latched = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
publisher = node.create_publisher(String, "words", latched)
while publisher.get_subscription_count() < 1:
    rclpy.spin_once(node, timeout_sec=0.1)
print("matched")
input()
for number in range(100):
    publisher.publish(String(data=f"{number} " + "x" * 100_000))
print("published")
node.destroy_node()
rclpy.shutdown()
print("ended")
"""


def udp_ports(pid):
    """UDP ports that a process has open."""
    inodes = set()
    for link in Path(f"/proc/{pid}/fd").iterdir():
        if match := re.fullmatch(r"socket:\[(\d+)\]", os.readlink(link)):
            inodes.add(match[1])
    rows = [line.split() for line in Path("/proc/net/udp").read_text().splitlines()[1:]]
    return sorted({int(row[1].partition(":")[2], 16) for row in rows if row[9] in inodes})


def nonsense(drawn):
    """Random bytes, or the head of an RTPS message with random submessages."""
    if drawn.random() < 0.2:
        return drawn.randbytes(drawn.randrange(1, 1400))
    message = b"RTPS" + bytes([2, drawn.choice([1, 5, 255]), 1, 16]) + drawn.randbytes(12)
    for _ in range(drawn.randrange(1, 8)):
        body = drawn.randbytes(drawn.choice([0, 4, 20, 24, 100]))
        length = drawn.choice([len(body), 0, 0xFFFF, drawn.randrange(0x10000)])
        message += struct.pack("<BBH", drawn.choice(KINDS), drawn.randrange(16), length) + body
    return message


def say(python, word):
    """Publish a word on /words from a separate process, once somebody listens."""
    return python(
        """
        import sys
        import rclpy
        from rclpy.duration import Duration
        from rclpy.qos import DurabilityPolicy, QoSProfile
        from std_msgs.msg import String

        rclpy.init()
        node = rclpy.create_node("speaker")
        latched = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        publisher = node.create_publisher(String, "words", latched)
        while publisher.get_subscription_count() < 1:
            rclpy.spin_once(node, timeout_sec=0.1)
        publisher.publish(String(data=sys.argv[1]))
        assert publisher.wait_for_all_acked(Duration(seconds=60))
        """,
        word,
    )


@pytest.mark.skipif(sys.platform != "linux", reason="finds ports in /proc")
def test_nonsense_at_all_ports_neither_kills_nor_floods(python, ends_well):
    listener = python(LISTENER)
    listener.wait_for("^up")
    ports = udp_ports(listener.process.pid)
    assert ports
    drawn = random.Random(1)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for _ in range(DATAGRAMS):
            sender.sendto(nonsense(drawn), ("127.0.0.1", drawn.choice(ports)))
    assert ends_well(say(python, "good")) == 0
    listener.wait_for("^heard good")
    listener.process.send_signal(signal.SIGINT)
    assert ends_well(listener) == 0
    assert listener.lines[-1][1] == "interrupted"


def test_a_reader_that_stopped_holds_up_no_publisher_and_no_exit(python, run, ends_well):
    listener = python(LISTENER)
    listener.wait_for("^up")
    talker = run(sys.executable, "-u", "-c", TALKER, terminal=True)
    talker.wait_for("^matched")
    listener.process.send_signal(signal.SIGSTOP)
    talker.type("go\n")
    talker.wait_for("^ended")
    assert ends_well(talker) == 0
    listener.process.send_signal(signal.SIGCONT)
    assert ends_well(say(python, "good")) == 0
    listener.wait_for("^heard good")
    listener.process.send_signal(signal.SIGINT)
    assert ends_well(listener) == 0


def test_silent_and_garbling_clients_do_not_keep_the_page_from_others(run, ends_well):
    turtles = run(
        ROS2,
        "run",
        "turtlesim",
        "turtlesim_node",
        environment={"TURTLEWIRE_PORT": "0", "TURTLEWIRE_BROWSER": "0"},
    )
    (match,) = turtles.wait_for(r"(http://[\w.:]+/)")
    host, port = match[1].removeprefix("http://").rstrip("/").split(":")
    drawn = random.Random(2)
    sockets = [socket.create_connection((host, int(port))) for _ in range(100)]
    for number, client in enumerate(sockets):
        if number % 4 == 1:
            client.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n")
        elif number % 4 == 2:
            client.sendall(drawn.randbytes(1000))
        elif number % 4 == 3:
            client.sendall(b"GET /ws HTTP/1.1\r\nUpgrade: websocket\r\n" + b"X: y\r\n" * 100)
    with urllib.request.urlopen(match[1], timeout=60) as answer:
        assert answer.status == 200
    for client in sockets:
        client.close()
    turtles.signal_group(signal.SIGINT)
    assert ends_well(turtles) == 0
    assert "Traceback" not in turtles.text
