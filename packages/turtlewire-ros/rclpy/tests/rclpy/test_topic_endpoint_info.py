import json
import re

import pytest
from tests.golden.cli.captures import capture

from rclpy.duration import Infinite
from rclpy.endpoint_info import EndpointTypeEnum, ServiceEndpointInfo
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, LivelinessPolicy, QoSProfile
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash
from tests import places
from turtlewire.wire import base, names
from turtlewire.wire.qos import INFINITE_NS, Durability, Liveliness, QoS, Reliability

HASH = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"


def test_the_text_is_that_of_ros_2():
    """Both endpoints that `ros2 topic info -v /turtle1/cmd_vel` of a real ROS 2 shows."""
    output = capture("187_topic_info_v_turtle1_cmd_vel").stdout
    shown = re.findall(r"Node name: .*?Liveliness lease duration: Infinite", output, re.DOTALL)
    assert len(shown) == 2
    for text in shown:
        gid = re.search(r"GID: (.*)", text)[1]
        info = TopicEndpointInfo(
            node_name=re.search(r"Node name: (.*)", text)[1],
            node_namespace="/",
            topic_type="geometry_msgs/msg/Twist",
            topic_type_hash=TypeHash.from_string(HASH),
            endpoint_type=TopicEndpointTypeEnum[re.search(r"Endpoint type: (.*)", text)[1]],
            endpoint_gid=[int(byte, 16) for byte in gid.split(".")],
            qos_profile=QoSProfile(
                depth=7,
                lifespan=Infinite,
                deadline=Infinite,
                liveliness=LivelinessPolicy.AUTOMATIC,
                liveliness_lease_duration=Infinite,
            ),
        )
        assert str(info) == text


def test_from_the_wire():
    qos = QoS(depth=3, deadline_ns=INFINITE_NS, liveliness=Liveliness.AUTOMATIC)
    endpoint = base.EndpointInfo(
        "publisher",
        "/a",
        "std_msgs/msg/String",
        HASH,
        base.NodeInfo("n", "/ns", "/"),
        bytes(range(16)),
        qos,
    )
    info = TopicEndpointInfo.from_wire(endpoint)
    assert (info.node_name, info.node_namespace, info.topic_type) == (
        "n",
        "/ns",
        "std_msgs/msg/String",
    )
    assert (info.endpoint_type, info.endpoint_gid) == (
        TopicEndpointTypeEnum.PUBLISHER,
        list(range(16)),
    )
    assert (str(info.topic_type_hash), info.qos_profile.deadline) == (HASH, Infinite)
    assert info == TopicEndpointInfo.from_wire(endpoint)
    nobody = TopicEndpointInfo.from_wire(
        endpoint._replace(node=None, type_hash="", kind="subscription")
    )
    assert (nobody.node_name, nobody.node_namespace) == (
        "_NODE_NAME_UNKNOWN_",
        "_NODE_NAMESPACE_UNKNOWN_",
    )
    assert str(nobody.topic_type_hash) == "INVALID"
    assert nobody != info
    everything = TopicEndpointInfo(qos_profile=QoSProfile(history=HistoryPolicy.KEEP_ALL))
    assert "  History (Depth): KEEP_ALL\n" in str(everything)


def test_type_hashes():
    assert (
        TypeHash()
        == TypeHash.from_string("RIHS01_12")
        == TypeHash.from_string("RIHS02_" + "0" * 64)
        == TypeHash.from_string("")
    )
    known = TypeHash.from_string(HASH)
    assert (known.version, known.value.hex(), str(known)) == (1, HASH[7:], HASH)
    assert (TypeHash().version, str(TypeHash(0, known.value)), known == HASH) == (
        -1,
        "INVALID",
        False,
    )
    for wrong in ({"version": "1"}, {"value": HASH}):
        with pytest.raises(AssertionError):
            TypeHash(**wrong)


def test_a_service_s_text_has_its_two_endpoints():
    """The block of `ros2 service info -v` of Lyrical."""
    qos = QoSProfile(
        depth=1000,
        lifespan=Infinite,
        deadline=Infinite,
        liveliness=LivelinessPolicy.AUTOMATIC,
        liveliness_lease_duration=Infinite,
    )
    info = ServiceEndpointInfo(
        node_name="turtlesim",
        node_namespace="/",
        service_type="turtlesim_msgs/srv/Spawn",
        service_type_hash=TypeHash.from_string(HASH),
        qos_profiles=[qos, qos],
        endpoint_gids=[[1, 171], [2, 0]],
        endpoint_type=EndpointTypeEnum.CLIENT,
        endpoint_count=2,
    )
    lines = [
        "Node name: turtlesim",
        "Node namespace: /",
        "Service type: turtlesim_msgs/srv/Spawn",
        f"Service type hash: {HASH}",
        "Endpoint type: CLIENT",
        "Endpoint count: 2",
        "GIDs:",
        " - Request Writer : 02.00",
        " - Response Reader : 01.ab",
        "QoS profiles:",
        " - Request Writer :",
        "      Reliability: RELIABLE",
        "      History (Depth): KEEP_LAST (1000)",
    ]
    assert str(info).splitlines()[: len(lines)] == lines
    assert str(info).splitlines()[18] == " - Response Reader :"
    info.endpoint_type = EndpointTypeEnum.SERVER
    assert str(info).splitlines()[7:9] == [
        " - Request Reader : 01.ab",
        " - Response Writer : 02.00",
    ]


def test_a_service_s_text_on_zenoh_has_one_endpoint():
    qos = QoSProfile(depth=10)
    info = ServiceEndpointInfo(qos_profiles=[qos], endpoint_gids=[[1, 2]], endpoint_count=1)
    lines = str(info).splitlines()
    assert lines[5:9] == [
        "Endpoint count: 1",
        "GID: 01.02",
        "QoS profile:",
        "  Reliability: RELIABLE",
    ]


@pytest.mark.parametrize("kind", [TopicEndpointInfo, ServiceEndpointInfo])
def test_values_of_other_types_are_refused(kind):
    info = kind(node_name="a", endpoint_type=2)
    assert info.endpoint_type is EndpointTypeEnum.SUBSCRIPTION
    with pytest.raises(AssertionError, match="expected an object of type str, got None"):
        info.node_name = None
    with pytest.raises(AssertionError, match="expected an object of type str"):
        kind(node_namespace=3)
    assert kind(node_name="a") == kind(node_name="a") != kind(node_name="b")


# The built-in endpoints of every node, compared with the endpoints that a real node announced
# (golden/wire/endpoints.json).


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
