from __future__ import annotations

import re

from rclpy.duration import Infinite
from rclpy.qos import LivelinessPolicy, QoSProfile
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash
from tests import places
from turtlewire.wire import base
from turtlewire.wire.qos import INFINITE_NS, Liveliness, QoS

GOLDEN = places.GOLDEN / "cli"
HASH = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"


def test_the_text_is_that_of_ros_2():
    """Both endpoints that `ros2 topic info -v /turtle1/cmd_vel` of a real ROS 2 shows."""
    output = (
        (GOLDEN / "187_topic_info_v_turtle1_cmd_vel.txt")
        .read_text()
        .split("----- stdout -----\n")[1]
    )
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


def test_type_hashes():
    assert (
        TypeHash()
        == TypeHash.from_string("RIHS01_12")
        == TypeHash.from_string("RIHS02_" + "0" * 64)
        == TypeHash.from_string("")
    )
    known = TypeHash.from_string(HASH)
    assert (known.version, known.value.hex(), str(known)) == (1, HASH[7:], HASH)
