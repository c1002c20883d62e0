"""What a broken peer may send over the real wire.

One clear line on stderr, the node lives, later good messages arrive.
"""

from __future__ import annotations

import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from tests.needs import needs_cyclone_dds

import rclpy
from example_interfaces.srv import AddTwoInts
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_msgs.msg import ByteMultiArray, String
from turtlesim.msg import Pose
from turtlewire import msg
from turtlewire.wire import report

HOSTILE = Path(__file__).parent / "peers" / "hostile.py"
HEADER = "00010000"
LIMIT_S = 60

#: name: message class, hostile messages in hex, what the one line says.
CASES = {
    "text_longer_than_the_message": (
        String,
        [HEADER + "ffffffff", HEADER + "40000000" + "61" * 8],
        "field 'data'",
    ),
    "text_that_is_not_utf8": (String, [HEADER + "03000000" + "c32800" + "00"] * 3, "UTF-8"),
    "too_short": (Pose, [HEADER + "00000000"] * 3, "Pose"),
    "sequence_longer_than_the_message": (
        ByteMultiArray,
        [HEADER + "00000000" * 2 + "ffffff7f" + "00" * 4] * 3,
        "data",
    ),
    "layout_of_four_billion_dimensions": (ByteMultiArray, [HEADER + "ffffffff" * 2] * 3, "dim"),
    "sequence_above_its_bound": (
        ParameterDescriptor,
        # name, type, description, additional_constraints, read_only, dynamic_typing,
        # floating_point_range, integer_range <= 1
        [
            HEADER
            + "01000000"
            + "00010000"
            + "01000000"
            + "00000000"
            + "01000000"
            + "00000000"
            + "00000000"
            + "02000000"
            + "00" * 52
        ]
        * 3,
        "integer_range",
    ),
    "noise": (Pose, [HEADER + "f7" * 3 + "00", HEADER + "81" * 12], "Pose"),
}


@pytest.fixture
def victim():
    """A node that spins."""
    context = rclpy.Context()
    context.init()
    node = rclpy.create_node("victim", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            return

    thread = threading.Thread(target=spin)
    thread.start()
    yield node
    node.destroy_node()
    context.try_shutdown()
    thread.join(LIMIT_S)
    assert not thread.is_alive()


def attack(lines: list[tuple[str, str, str, str]], *effects: threading.Event) -> None:
    """Send all, from another process, which stays until each of the ``effects`` was seen.

    One of them should be the arrival of the good message at the end. Messages of several
    publishers may arrive in any order, and what is not there yet when the process ends is lost.
    """
    text = "".join(" ".join(line) + "\n" for line in lines) + "\n"
    with subprocess.Popen(
        [sys.executable, HOSTILE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as peer:
        assert peer.stdin is not None
        assert peer.stdout is not None
        peer.stdin.write(text)
        peer.stdin.flush()
        assert peer.stdout.readline() == "sent\n"
        assert all(effect.wait(LIMIT_S) for effect in effects)
        peer.communicate()


def complaints(text: str) -> list[str]:
    return [line for line in text.splitlines() if re.search("ERROR|WARN|Traceback", line)]


@pytest.mark.parametrize("name", CASES)
def test_a_malformed_message_is_named_once_and_the_next_good_one_arrives(victim, name, capfd):
    cls, hostile, reason = CASES[name]
    got, arrived = [], threading.Event()
    victim.create_subscription(
        cls, f"/{name}", lambda message: (got.append(message), arrived.set()), 100
    )
    type_name = msg.type_name(cls)
    identity = (f"/{name}", type_name, msg.type_hash(type_name))
    good = msg.serialize(cls()).hex()
    attack([(*identity, data) for data in hostile] + [(*identity, good)], arrived)
    assert got == [cls()]
    [line] = complaints(capfd.readouterr().err)
    assert f"Ignoring a malformed message on topic '/{name}'" in line
    assert reason in line


@needs_cyclone_dds  # with Zenoh, the hash of the type is in the key
def test_a_type_of_our_name_with_other_fields_is_named_once(victim, capfd, monkeypatch):
    """Three longs where we have five floats.

    As many bytes, so that only the hash tells the difference.
    """
    monkeypatch.setattr(report, "_said", set())
    got, arrived, warned = [], threading.Event(), threading.Event()
    warn = report.warn
    monkeypatch.setattr(report, "warn", lambda text: (warn(text), warned.set()))

    def on_pose(message: Pose) -> None:
        got.append(message)
        if message.x == 7.0:
            arrived.set()

    victim.create_subscription(Pose, "/pose", on_pose, 100)
    ours, theirs = msg.type_hash("turtlesim/msg/Pose"), "RIHS01_" + "5" * 64
    foreign = ("/pose", "turtlesim/msg/Pose", theirs, HEADER + "01000000" * 6)
    good = ("/pose", "turtlesim/msg/Pose", ours, msg.serialize(Pose(x=7.0)).hex())
    attack([foreign] * 3 + [good], arrived, warned)
    [line] = complaints(capfd.readouterr().err)
    assert "a peer on /pose has another definition of turtlesim/msg/Pose" in line
    assert "same version of turtlesim" in line
    assert theirs in line
    assert ours in line


@needs_cyclone_dds
def test_malformed_requests_are_named_once_and_the_service_answers(victim, capfd, monkeypatch):
    answered, warned = threading.Event(), threading.Event()
    logger = victim.get_logger()
    error = logger.error
    monkeypatch.setattr(
        logger, "error", lambda *args, **options: (error(*args, **options), warned.set())
    )
    victim.create_service(
        AddTwoInts,
        "/add",
        lambda request, response: setattr(response, "sum", request.a + request.b) or response,
    )
    client = victim.create_client(AddTwoInts, "/add")
    part = "example_interfaces/srv/AddTwoInts_Request"
    sentinel = threading.Event()
    victim.create_subscription(String, "/sentinel", lambda _: sentinel.set(), 10)
    hostile = ("rq/addRequest", part, msg.type_hash(part), HEADER + "01" * 16 + "01020304")
    text = "std_msgs/msg/String"
    attack(
        [hostile] * 3 + [("/sentinel", text, msg.type_hash(text), msg.serialize(String()).hex())],
        sentinel,
        warned,
    )
    assert client.wait_for_service(LIMIT_S)
    future = client.call_async(AddTwoInts.Request(a=1, b=2))
    future.add_done_callback(lambda _: answered.set())
    assert answered.wait(LIMIT_S)
    assert future.result().sum == 3
    [line] = complaints(capfd.readouterr().err)
    assert "Ignoring a malformed request to service '/add'" in line
