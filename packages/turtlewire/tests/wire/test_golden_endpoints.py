"""Another vendor's DDS peer sees our nodes as it saw the nodes of a real ROS 2."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections import Counter
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests import places
from turtlewire.wire import names, open_context
from turtlewire.wire.base import Context, Node, ServiceTypes, TypeId
from turtlewire.wire.cyclone.configuration import domain_configuration
from turtlewire.wire.environment import discovery
from turtlewire.wire.graph import parse_user_data
from turtlewire.wire.qos import INFINITE_NS, Durability, History, QoS, Reliability

GOLDEN = places.GOLDEN / "wire"
PEER = Path(__file__).parent / "peers" / "builtin_topics.py"
IDS = re.compile(r"^(clientid|serviceid)=[ 1-9a-f][0-9a-f](\.[0-9a-f]{1,2}){15};")


def load(name: str):
    return json.loads((GOLDEN / name).read_text())


@pytest.mark.skipif(find_spec("cyclonedds") is None, reason="the peer needs the cyclonedds wheel")
def test_endpoints_and_participants_equal_those_of_a_real_ros_2():
    golden = load("endpoints.json")
    of_nodes = {
        node: endpoints for node, endpoints in golden["nodes"].items() if node.startswith("/")
    }
    of_participant = golden["nodes"]["(participant level, no node)"]
    context = open_context(middleware="rmw_cyclonedds_cpp")
    try:
        assert (
            context.graph.nodes() == []
        )  # its reader of ros_discovery_info belongs to the picture
        for node, endpoints in of_nodes.items():
            namespace, _, name = node.rpartition("/")
            create_all(context.create_node(name, namespace or "/"), endpoints)
        expected = [
            endpoint for endpoints in (*of_nodes.values(), of_participant) for endpoint in endpoints
        ]
        seen, participants = look_with_a_foreign_peer(context, len(expected))
    finally:
        context.close()
    assert len(expected) == 79
    assert Counter(map(comparable, seen)) == Counter(
        comparable(complete(endpoint, golden["qos_common_to_all"])) for endpoint in expected
    )
    check_service_ids(seen)
    [participant] = participants
    assert participant["user_data"] in {golden["user_data"] for golden in load("participants.json")}


def create_all(node: Node, endpoints: list[dict]) -> None:
    """Create what the golden file lists of one node."""
    by_topic = {(endpoint["kind"], endpoint["topic"]): endpoint for endpoint in endpoints}
    for endpoint in endpoints:
        kind, topic = endpoint["kind"], endpoint["topic"]
        service = names.service_from_dds(topic)
        if service is None and kind == "writer":
            node.create_publisher(
                "/" + topic.partition("/")[2], type_of(endpoint), qos_of(endpoint)
            )
        elif service is None:
            node.create_subscription(
                "/" + topic.partition("/")[2], type_of(endpoint), qos_of(endpoint)
            )
        elif topic.startswith("rq/"):
            reply = by_topic["writer" if kind == "reader" else "reader", names.reply_topic(service)]
            create = node.create_service if kind == "reader" else node.create_client
            types = ServiceTypes("", type_of(endpoint), type_of(reply), lambda _: "")
            create(service, types, qos_of(endpoint))


def type_of(endpoint: dict) -> TypeId:
    return TypeId(
        names.type_from_dds(endpoint["type"]),
        parse_user_data(endpoint["user_data"].encode())["typehash"],
    )


def qos_of(endpoint: dict) -> QoS:
    qos = endpoint["qos"]
    lifespan = qos.get("Lifespan", {}).get("lifespan", INFINITE_NS)
    return QoS(
        History.KEEP_ALL if qos["History"]["kind"] == "KeepAll" else History.KEEP_LAST,
        qos["History"].get("depth", 0),
        Reliability.RELIABLE
        if qos["Reliability"]["kind"] == "Reliable"
        else Reliability.BEST_EFFORT,
        Durability.TRANSIENT_LOCAL
        if qos["Durability"]["kind"] == "TransientLocal"
        else Durability.VOLATILE,
        lifespan_ns=0 if lifespan == INFINITE_NS else lifespan,
    )


def look_with_a_foreign_peer(context: Context, count: int) -> tuple[list[dict], list[dict]]:
    environment = os.environ | {
        "CYCLONEDDS_URI": domain_configuration(context.domain_id, discovery())
    }
    command = [sys.executable, PEER, str(count), str(context.domain_id)]
    peer = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    lines = [json.loads(line) for line in peer.stdout.splitlines()]
    prefix = context.gid[:12].hex()
    ours = [line for line in lines if line["key"].startswith(prefix)]
    return [line for line in ours if line["kind"] != "participant"], [
        line for line in ours if line["kind"] == "participant"
    ]


def complete(endpoint: dict, common: dict) -> dict:
    return endpoint | {"qos": common | endpoint["qos"]}


def comparable(endpoint: dict) -> str:
    """Return one string per endpoint, without intended and random differences."""
    qos = json.loads(json.dumps(endpoint["qos"]))
    if endpoint["kind"] == "writer":
        qos["Reliability"].pop(
            "max_blocking_time", None
        )  # ours gives up after a second instead of never
    user_data = IDS.sub(r"\1=(id);", endpoint["user_data"])
    return json.dumps(
        [endpoint["kind"], endpoint["topic"], endpoint["type"], user_data, qos], sort_keys=True
    )


def check_service_ids(endpoints: list[dict]) -> None:
    """Both ends of a service have one id, and no two services have the same."""
    ids: dict[str, set[str]] = {}
    for endpoint in endpoints:
        service = names.service_from_dds(endpoint["topic"])
        if service is not None:
            ids.setdefault(service, set()).add(endpoint["user_data"].partition(";")[0])
    assert all(len(found) == 1 for found in ids.values())
    assert len(set().union(*ids.values())) == len(ids)
