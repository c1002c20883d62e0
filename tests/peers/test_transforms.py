"""Transforms at 1 kHz pass between ours and real nodes on Fast DDS with nothing lost."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from turtlewire import Buffer, msg
from turtlewire.tf.listener import TransformListener
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

pytestmark = pytest.mark.slow

TRANSFORMS = Path(__file__).with_name("transforms.py")
COUNT = 3000
#: So deep that nothing is lost while a busy computer stops one of the nodes.
QOS = QoS(depth=10_000)
SECOND, MILLISECOND = 1_000_000_000, 1_000_000


def test_our_buffer_gets_all_transforms_of_a_real_node(context, real):
    buffer = Buffer()
    with TransformListener(buffer, context=context, qos=QOS):
        real("send", COUNT, program=TRANSFORMS)
        last = buffer.lookup_transform(
            "world", "robot", COUNT * MILLISECOND, timeout_ns=60 * SECOND
        )
    (link,) = buffer.links()
    assert (link.samples, link.rate_hz) == (COUNT, 1000.0)
    assert last.translation == (1.0, 2.0, 3.0)


def test_a_real_node_gets_all_our_transforms(context, real):
    peer = real("receive", COUNT, program=TRANSFORMS)
    name = "tf2_msgs/msg/TFMessage"
    publisher = context.create_node("ours").create_publisher(
        "/tf", TypeId(name, msg.type_hash(name)), QOS
    )
    assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, 60 * SECOND)
    peer.wait_for("publishers of /tf: 1")
    transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
    message = msg.get_message(name)(transforms=[transform])
    start = time.monotonic_ns()
    for number in range(1, COUNT + 1):
        time.sleep(max(0, start + number * MILLISECOND - time.monotonic_ns()) / SECOND)
        stamp = transform.header.stamp
        stamp.sec, stamp.nanosec = divmod(number * MILLISECOND, SECOND)
        publisher.publish(msg.serialize(message))
    (received,) = peer.wait_for(r"^received (\d+)")
    assert int(received[1]) == COUNT
