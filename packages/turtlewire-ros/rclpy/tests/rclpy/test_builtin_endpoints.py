"""The built-in endpoints of every node, compared with the endpoints that a real node announced
(golden/wire/endpoints.json).
"""

from __future__ import annotations

import json
import re

from rclpy.node import Node
from tests import places
from turtlewire.wire import names
from turtlewire.wire.qos import INFINITE_NS, Durability, Reliability

GOLDEN = places.GOLDEN / "wire" / "endpoints.json"


def announced():
    """Of `/ns1/bare_node`.

    (reader or writer, topic, type, its hash, reliable, transient local, depth, lifespan).
    """
    for each in json.loads(GOLDEN.read_text())["nodes"]["/ns1/bare_node"]:
        qos = each["qos"]
        yield (
            each["kind"],
            each["topic"],
            each["type"],
            re.search(r"RIHS01_\w+", each["user_data"])[0],
            qos["Reliability"]["kind"] == "Reliable",
            qos["Durability"]["kind"] == "TransientLocal",
            qos["History"]["depth"],
            qos.get("Lifespan", {}).get("lifespan", INFINITE_NS),
        )


def ours(graph):
    for each in graph.endpoints():
        yield (
            "writer" if each.kind == "publisher" else "reader",
            names.topic_to_dds(each.topic) if each.topic.startswith("/") else each.topic,
            names.type_to_dds(each.type_name),
            each.type_hash,
            each.qos.reliability == Reliability.RELIABLE,
            each.qos.durability == Durability.TRANSIENT_LOCAL,
            each.qos.depth,
            each.qos.lifespan_ns or INFINITE_NS,
        )


def test_a_bare_node_announces_what_a_real_one_does(context):
    node = Node("bare_node", namespace="/ns1", context=context)
    golden = sorted(announced())
    assert len(golden) == 16
    assert sorted(ours(context.wire.graph)) == golden
    node.destroy_node()
    assert context.wire.graph.endpoints() == []


def test_the_type_description_service_can_be_destroyed(context):
    node = Node("described", context=context, start_parameter_services=False)
    service = node._type_description_service
    assert len(list(node.services)) == 1
    service.destroy()
    service.destroy()
    assert list(node.services) == []
