"""``WaitForTopics`` of launch_testing_ros, apart from waiting."""

import pytest

from launch_testing_ros import WaitForTopics
from rclpy.qos import QoSProfile
from std_msgs.msg import String


@pytest.fixture(autouse=True)
def _local(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")


def test_the_trigger_gets_the_node_and_the_arguments_of_wait():
    def publish(node, text, *, times):
        publisher = node.create_publisher(String, "chatter", 10)
        for _ in range(times):
            publisher.publish(String(data=f"{text} in {node.get_namespace()}"))

    topics = WaitForTopics(
        [("chatter", String)],
        timeout=60.0,
        trigger=publish,
        node_namespace="waiting",
        qos_profile=QoSProfile(depth=5),
    )
    try:
        assert topics.wait("Hello", times=2)
        assert topics.received_messages("chatter")[0].data == "Hello in /waiting"
    finally:
        topics.shutdown()


def test_the_trigger_of_a_with_block_gets_the_node():
    def publish(node):
        node.create_publisher(String, "/chatter", 10).publish(String(data="Hello"))

    with WaitForTopics([("/chatter", String)], timeout=60.0, trigger=publish) as topics:
        assert topics.topics_received() == {"/chatter"}
