"""Messages of many types pass between ours and real nodes on Fast DDS with every field."""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import pytest
from tests.peers.fields import fields

from turtlewire import msg
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
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS

pytestmark = pytest.mark.slow

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
