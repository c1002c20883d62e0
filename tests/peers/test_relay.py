"""A relay lets nodes on Cyclone DDS and on Fast DDS call each other.

The client on Cyclone DDS does not speak Fast DDS itself, like those of rmw_cyclonedds_cpp.

The doctor names real nodes on Fast DDS that do not receive over UDPv4.
"""

import os
import re

import pytest
from tests.places import BIN

pytestmark = pytest.mark.slow

#: Services with Fast DDS need the compiled core.
CYCLONE_ONLY = {"TURTLEWIRE_CORE": "python"}


@pytest.fixture
def relay(run):
    """Starts a relay of this domain, which offers all names in /relayed as well."""

    def start():
        end = f"cyclonedds:{os.environ['ROS_DOMAIN_ID']}"
        words = ("relay", "--from", end, "--to", end, "--namespace", "relayed")
        return run(BIN / "turtlewire", *words)

    return start


def test_a_client_on_cyclone_calls_a_server_on_fast_dds(peer, relay, command):
    relay().wait_for("/echo -> .* /relayed/echo")
    words = ("service", "call", "/relayed/echo", "test_msgs/srv/BasicTypes", "{int64_value: 77}")
    status, text = command("ros2", *words, **CYCLONE_ONLY)
    assert (status, "int64_value=77" in text) == (0, True), text
    # For a second: feedback before the client is discovered goes to nobody.
    goal = ("/relayed/fibonacci", "test_msgs/action/Fibonacci", "{order: 50}")
    status, text = command("ros2", "action", "send_goal", "-f", *goal, **CYCLONE_ONLY)
    assert (status, "SUCCEEDED" in text, "Feedback:" in text) == (0, True, True), text
    for words, told in (
        (("set", "/relayed/peer", "speed", "2.5"), "Set parameter successful"),
        (("get", "/relayed/peer", "speed"), "Double value is: 2.5"),
    ):
        status, text = command("ros2", "param", *words, **CYCLONE_ONLY)
        assert (status, told in text) == (0, True), text
    assert re.findall(r"called (-?\d+)", peer.text) == ["77"]


def test_a_client_on_fast_dds_calls_a_server_on_cyclone(real, relay, serve):
    serve(**CYCLONE_ONLY)
    relay().wait_for("/echo -> .* /relayed/echo")
    client = real("client", "20", "1000", "30", "/relayed/echo")
    assert client.wait() == 0, client.text
    assert re.findall(r"answer: (\w+)", client.text) == [str(number) for number in range(20)]
    parameters = real("parameters", "/relayed/ours")
    assert parameters.wait() == 0, parameters.text
    assert "speed: 2.5" in parameters.text


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
