"""`launch_testing_ros`: a launch in a separate domain, and `WaitForTopics` apart from waiting."""

import os
import sys

import pytest

from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess
from launch_testing_ros import WaitForTopics
from launch_testing_ros.actions import EnableRmwIsolation
from rclpy.qos import QoSProfile
from std_msgs.msg import String
from turtlewire.testing import reserved_domain

PROGRAM = "import os, pathlib; pathlib.Path({!r}).write_text(os.environ['ROS_DOMAIN_ID'])"


@pytest.mark.parametrize("former", [None, "0"])
@pytest.mark.parametrize("times", [1, 2])
def test_the_processes_have_a_domain_of_their_own(monkeypatch, tmp_path, former, times):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    if former is not None:
        monkeypatch.setenv("ROS_DOMAIN_ID", former)
    file = tmp_path / "domain"
    isolation = [EnableRmwIsolation()] * times
    with reserved_domain() as taken:  # the first free one, which the launch would take
        service = LaunchService(noninteractive=True)
        node = ExecuteProcess(cmd=[sys.executable, "-c", PROGRAM.format(str(file))])
        service.include_launch_description(LaunchDescription([*isolation, node]))
        assert service.run() == 0
        assert 1 <= int(file.read_text()) <= 101
        assert file.read_text() != str(taken)
    assert os.environ.get("ROS_DOMAIN_ID") == former


@pytest.fixture
def local(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")


@pytest.mark.usefixtures("local")
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


@pytest.mark.usefixtures("local")
def test_the_trigger_of_a_with_block_gets_the_node():
    def publish(node):
        node.create_publisher(String, "/chatter", 10).publish(String(data="Hello"))

    with WaitForTopics([("/chatter", String)], timeout=60.0, trigger=publish) as topics:
        assert topics.topics_received() == {"/chatter"}
