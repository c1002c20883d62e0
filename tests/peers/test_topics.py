"""Topics pass both ways between ours and real nodes on Fast DDS.

Messages of many types pass between ours and real nodes on Fast DDS with every field.

Transforms at 1 kHz pass between ours and real nodes on Fast DDS with nothing lost.
"""

import itertools
import json
import re
import socket
import sys
import time
from pathlib import Path

import pytest
from tests.peers.fields import fields
from tests.places import ROOT

from turtlewire import Buffer, msg
from turtlewire.msg.registry import load_message
from turtlewire.msg.types import (
    INTEGER_RANGES,
    AbstractNestedType,
    AbstractString,
    AbstractWString,
    Array,
    BasicType,
    NamespacedType,
)
from turtlewire.tf.listener import TransformListener
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability

pytestmark = pytest.mark.slow

LONG = 60_000_000_000
PAGE = ROOT / "docs" / "compatibility.md"
RECEIVE_BUFFER = 4_194_304
IMAGES = 20


def type_id(name):
    return TypeId(name, msg.type_hash(name))


def matched_publisher(context, peer, topic, type_name, qos=QoS()):  # noqa: B008 - a named tuple
    """A publisher of ours that the real node has matched, too: what it sends arrives."""
    publisher = context.create_node("ours").create_publisher(topic, type_id(type_name), qos)
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG)
    peer.wait_for(rf"publishers of {topic}: 1")
    return publisher


def test_messages_go_both_ways(peer, context):
    name = "geometry_msgs/msg/TransformStamped"
    node = context.create_node("ours")
    moved = node.create_subscription("/moved", type_id(name), QoS())
    # the answer goes to our subscription once the real node knows it
    assert context.graph.wait_for(lambda: moved.publisher_count() == 1, LONG)
    publisher = matched_publisher(context, peer, "/move", name)
    wait_set = context.create_wait_set()
    wait_set.attach(moved)
    sent = msg.get_message(name)()
    sent.header.frame_id, sent.child_frame_id = "world", "räder/links"
    sent.header.stamp.sec, sent.transform.rotation.z = 12, 0.5
    received = []
    while not received:
        publisher.publish(msg.serialize(sent))
        wait_set.wait(200_000_000)
        received = moved.take()
    sent.transform.translation.x += 1.0
    assert msg.deserialize(msg.get_message(name), received[0][0]) == sent


def test_the_end_of_a_publisher_is_seen_while_its_process_goes_on(peer, context):
    publisher = matched_publisher(context, peer, "/heard", "std_msgs/msg/String")
    publisher.publish(msg.serialize(msg.get_message("std_msgs/msg/String")(data="ours")))
    peer.wait_for("heard ours")
    publisher.close()
    peer.wait_for("publishers of /heard: 0")


def test_topic_info_shows_no_history_that_was_not_announced(peer, command):
    status, text = command("ros2", "topic", "info", "-v", "/chatter")
    assert status == 0
    assert "  History (Depth): UNKNOWN\n" in text


def test_a_node_that_publishes_its_statistics_is_no_trouble(start_peer, command):
    start_peer(FASTDDS_STATISTICS="NETWORK_LATENCY_TOPIC;RTPS_SENT_TOPIC;DISCOVERY_TOPIC")
    status, text = command("ros2", "topic", "echo", "--once", "/chatter", "std_msgs/msg/String")
    assert status == 0
    assert text == "data: from Fast DDS\n---"


def publish_images(context, peer, topic, qos, size):
    name = "sensor_msgs/msg/Image"
    publisher = matched_publisher(context, peer, topic, name, qos)
    image = msg.get_message(name)(data=bytes(size))
    for number in range(IMAGES):
        image.header.frame_id = str(number)
        publisher.publish(msg.serialize(image))
        peer.wait_for(f"image {number} {size}", timeout=60)


@pytest.mark.parametrize("size", [100_000, 384_000, 1_000_000, 8_000_000])
def test_images_arrive_at_a_reliable_subscription(peer, context, size):
    publish_images(context, peer, "/image", QoS(), size)


@pytest.fixture
def heartbeats(monkeypatch):
    """The documented setting, before the context of the test is opened."""
    (setting,) = re.findall(r"HEARTBEATS='(.*)'", PAGE.read_text())
    monkeypatch.setenv("CYCLONEDDS_URI", f"<Internal>{setting}</Internal>")


def test_a_flow_of_images_arrives_with_the_documented_heartbeats(heartbeats, peer, context):
    name, size = "sensor_msgs/msg/Image", 384_000
    image = msg.get_message(name)(data=bytes(size))
    publisher = matched_publisher(context, peer, "/image", name)
    for number in range(IMAGES):
        image.header.frame_id = str(number)
        publisher.publish(msg.serialize(image))
        time.sleep(0.1)  # the rate
    peer.wait_for(rf"image \d+ {size}", count=IMAGES, timeout=60)


def test_images_arrive_with_the_documented_profile(start_peer, context, tmp_path):
    limit = int(Path("/proc/sys/net/core/rmem_max").read_text())
    if limit < RECEIVE_BUFFER:
        pytest.skip(f"net.core.rmem_max is {limit} (sysctl -w net.core.rmem_max={RECEIVE_BUFFER})")
    (profile,) = re.findall(r"```xml\n(.*?)```", PAGE.read_text(), re.DOTALL)
    (tmp_path / "profile.xml").write_text(profile)
    path = str(tmp_path / "profile.xml")
    variables = {"FASTRTPS_DEFAULT_PROFILES_FILE": path, "FASTDDS_DEFAULT_PROFILES_FILE": path}
    peer = start_peer(**variables)
    qos = QoS(reliability=Reliability.BEST_EFFORT)
    publish_images(context, peer, "/camera", qos, 1_000_000)


def own_address():
    """An address of this computer that is not the loopback one; empty if it has none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as route:
        try:
            route.connect(("203.0.113.1", 9))  # sends nothing
        except OSError:
            return ""
        return str(route.getsockname()[0])


def test_debians_cyclone_finds_the_node_by_an_address_of_this_computer(peer, command):
    if not list(Path("/usr/lib").glob("*/libddsc.so.0.10*")):
        pytest.skip("no libddsc 0.10 in /usr/lib (Debian: apt install libddsc0debian)")
    if not (address := own_address()):
        pytest.skip("this computer has no route but the loopback one")
    words = ("topic", "echo", "--once", "/chatter", "std_msgs/msg/String")
    status, text = command("ros2", *words, CYCLONEDDS_HOME="/usr", ROS_STATIC_PEERS=address)
    assert status == 0
    assert "data: from Fast DDS" in text


# Endpoints of ours and of real nodes on Fast DDS match if ROS 2's rules say so.


PAIRS = Path(__file__).with_name("pairs.py")
COUNT = 72


def outcomes(program, pattern):
    """Return the matches of the pattern in the lines of all pairs, by the number of the pair."""
    lines = program.wait_for(rf"^(\d+) {pattern}", count=COUNT)
    return {int(line[1]): line[2] for line in lines}


def test_72_pairs_match_or_not_as_rclpy_says(real, run):
    theirs = real("theirs", program=PAIRS)
    cyclone = {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}
    ours = run(sys.executable, PAIRS, "ours", environment=cyclone)
    rule = outcomes(theirs, "rule (.*)")
    assert outcomes(ours, "rule (.*)") == rule
    ends = outcomes(ours, "(matched|incompatible .*)")
    assert outcomes(theirs, "(matched|incompatible .*)") == ends
    assert {n for n, end in ends.items() if end == "matched"} == {
        n for n, text in rule.items() if text == "OK"
    }
    assert len(ends) == COUNT


ECHO = Path(__file__).with_name("echo.py")
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
SECOND = 1_000_000_000
TYPES = [
    "action_msgs/msg/GoalStatusArray",
    "builtin_interfaces/msg/Time",
    "diagnostic_msgs/msg/DiagnosticArray",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/TransformStamped",
    "nav_msgs/msg/OccupancyGrid",
    "nav_msgs/msg/Odometry",
    "nav_msgs/msg/Path",
    "rcl_interfaces/msg/ParameterDescriptor",
    "rcl_interfaces/msg/ParameterEvent",
    "sensor_msgs/msg/CameraInfo",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/PointCloud2",
    "std_msgs/msg/Empty",
    "std_msgs/msg/Float64MultiArray",
    "std_msgs/msg/String",
    "test_msgs/msg/Arrays",
    "test_msgs/msg/BoundedSequences",
    "test_msgs/msg/Nested",
    "test_msgs/msg/UnboundedSequences",
    "test_msgs/msg/WStrings",
    "trajectory_msgs/msg/JointTrajectory",
    "visualization_msgs/msg/MarkerArray",
]


class Filler:
    """Makes messages in which no two numbers or texts that follow each other are the same."""

    def __init__(self):
        self.numbers = itertools.count(1)

    def message(self, name):
        values = {field.name: self.value(field.type) for field in load_message(name).fields}
        return msg.get_message(name)(**values)

    def value(self, type_):
        if isinstance(type_, AbstractNestedType):
            size = type_.size if isinstance(type_, Array) else getattr(type_, "maximum_size", 3)
            return [self.value(type_.value_type) for _ in range(size)]
        if isinstance(type_, NamespacedType):
            return self.message(type_.full_name)
        number = next(self.numbers)
        if isinstance(type_, (AbstractString, AbstractWString)):
            return f"größe {number} €"
        assert isinstance(type_, BasicType)
        if type_.typename in INTEGER_RANGES:
            low, high = INTEGER_RANGES[type_.typename]
            return (low, high, number % (high + 1))[number % 3]
        if type_.typename == "boolean":
            return number % 2 == 0
        return bytes([number % 256]) if type_.typename == "octet" else -number / 4


def receive(context, subscriptions):
    """The first message of each subscription."""
    wait_set, received = context.create_wait_set(), {}
    for subscription in subscriptions:
        wait_set.attach(subscription)
    while len(received) < len(subscriptions):
        ready = wait_set.wait(60 * SECOND)
        assert ready, sorted(received)
        for subscription in ready:
            ((received[subscription.topic], _),) = subscription.take()
    return [received[subscription.topic] for subscription in subscriptions]


def test_every_field_arrives_in_both_directions(context, real, venv, monkeypatch):
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(venv))  # it has the definitions of test_msgs
    peer = real(*TYPES, program=ECHO)
    node, filler = context.create_node("ours"), Filler()
    sent, subscriptions = [], []
    for number, name in enumerate(TYPES):
        type_id = TypeId(name, msg.type_hash(name))
        publisher = node.create_publisher(f"/ours_{number}", type_id, LATCHED)
        subscriptions.append(node.create_subscription(f"/theirs_{number}", type_id, LATCHED))
        sent.append(filler.message(name))
        publisher.publish(msg.serialize(sent[-1]))
    for name, message, data in zip(TYPES, sent, receive(context, subscriptions), strict=True):
        (printed,) = peer.wait_for(f"^{name} (.*)")
        assert json.loads(printed[1]) == fields(message), name
        assert msg.deserialize(msg.get_message(name), data) == message


TRANSFORMS = Path(__file__).with_name("transforms.py")
SENT = 3000
#: So deep that nothing is lost while a busy computer stops one of the nodes.
QOS = QoS(depth=10_000)
SECOND, MILLISECOND = 1_000_000_000, 1_000_000


def test_our_buffer_gets_all_transforms_of_a_real_node(context, real):
    buffer = Buffer()
    with TransformListener(buffer, context=context, qos=QOS):
        real("send", SENT, program=TRANSFORMS)
        last = buffer.lookup_transform("world", "robot", SENT * MILLISECOND, timeout_ns=60 * SECOND)
    (link,) = buffer.links()
    assert (link.samples, link.rate_hz) == (SENT, 1000.0)
    assert last.translation == (1.0, 2.0, 3.0)


def test_a_real_node_gets_all_our_transforms(context, real):
    peer = real("receive", SENT, program=TRANSFORMS)
    name = "tf2_msgs/msg/TFMessage"
    publisher = context.create_node("ours").create_publisher(
        "/tf", TypeId(name, msg.type_hash(name)), QOS
    )
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, 60 * SECOND)
    peer.wait_for("publishers of /tf: 1")
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
    message = msg.get_message(name)(transforms=[transform])
    start = time.monotonic_ns()
    for number in range(1, SENT + 1):
        time.sleep(max(0, start + number * MILLISECOND - time.monotonic_ns()) / SECOND)
        stamp = transform.header.stamp
        stamp.sec, stamp.nanosec = divmod(number * MILLISECOND, SECOND)
        publisher.publish(msg.serialize(message))
    (received,) = peer.wait_for(r"^received (\d+)")
    assert int(received[1]) == SENT
