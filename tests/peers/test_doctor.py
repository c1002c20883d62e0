"""The doctor names real nodes on Fast DDS that do not receive over UDPv4."""

from __future__ import annotations

import re

import pytest

pytestmark = pytest.mark.slow

SILENT = (
    "PROBLEM: Topics of participants on Fast DDS stay silent, because they do not receive over "
)


@pytest.mark.parametrize("range_", ["LOCALHOST", "SUBNET"])
@pytest.mark.parametrize(
    ("transports", "how"), [("LARGE_DATA", "shared memory and TCPv4"), ("SHM", "shared memory")]
)
def test_nodes_without_udp_are_named(real, command, range_, transports, how):
    node = real(
        "crowd", ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET", FASTDDS_BUILTIN_TRANSPORTS=transports
    )
    node.wait_for("up")
    status, text = command("turtlewire", "doctor", ROS_AUTOMATIC_DISCOVERY_RANGE=range_)
    assert status == 1
    (line,) = [line for line in text.splitlines() if line.startswith(SILENT)]
    owner = rf"process {node.process.pid} '.*python .*'"
    assert re.fullmatch(rf"{re.escape(SILENT)}UDPv4: {owner} \({how}\)\.", line), line
    assert "No nodes found" not in text


@pytest.mark.parametrize("transports", ["DEFAULT", "UDPv4"])
def test_the_remedy_helps(real, command, transports):
    node = real(
        "crowd", ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET", FASTDDS_BUILTIN_TRANSPORTS=transports
    )
    node.wait_for("up")
    status, text = command("turtlewire", "doctor")
    assert (status, "stay silent" in text) == (0, False), text
    assert "1 on Fast DDS" in text


def test_in_the_range_localhost_nodes_with_large_data_are_reached(start_peer, command):
    start_peer(FASTDDS_BUILTIN_TRANSPORTS="LARGE_DATA")
    words = ("topic", "echo", "--once", "/chatter", "std_msgs/msg/String")
    assert command("ros2", *words) == (0, "data: from Fast DDS\n---")
