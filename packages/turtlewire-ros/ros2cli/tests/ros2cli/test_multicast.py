"""`ros2 multicast`: one datagram from a sender to a receiver."""

import subprocess

import pytest
from tests.programs import ROS2, ROS2_IN_SHELL

from ros2cli.main import main


def test_a_datagram_arrives(run, capsys):
    receiver = run(*ROS2, "multicast", "receive", "--port", "49151")
    receiver.wait_for(r"^Waiting for UDP multicast datagram\.\.\.$")
    assert main(["multicast", "send", "--port", "49151", "--ttl", "0"]) == 0  # not beyond this host
    assert capsys.readouterr().out == "Sending one UDP multicast datagram...\n"
    receiver.wait_for(r"^Received from [0-9.]+:\d+: 'Hello World!'$")
    assert receiver.wait() == 0


OWN_NETWORK = (
    subprocess.run(
        "unshare -n ip link set lo up", shell=True, capture_output=True, check=False
    ).returncode
    == 0
)


@pytest.mark.skipif(
    not OWN_NETWORK,
    reason="a separate network needs root, unshare and ip (Debian: apt install iproute2)",
)
def test_without_a_network_it_arrives_on_the_same_host(run):
    receive_and_send = f"""
        ip link set lo up
        {{ {ROS2_IN_SHELL} multicast receive; echo "status $?"; }} | while read -r line; do
            echo "$line"
            case $line in Waiting*) {ROS2_IN_SHELL} multicast send ;; esac
        done
    """
    both = run("unshare", "-n", "sh", "-c", receive_and_send)
    both.wait_for(r"^Received from 127\.0\.0\.1:\d+: 'Hello World!'$")
    both.wait_for("no route leads to the group 225.0.0.1: the datagrams stay on this host", count=2)
    both.wait_for("^status 0$")
    assert both.wait() == 0


@pytest.mark.parametrize(
    ("option", "value", "told"),
    [
        (
            "--group",
            "127.0.0.1",
            "'127.0.0.1' is not an IPv4 multicast group, 224.0.0.0 to 239.255.255.255",
        ),
        ("--group", "nope", "'nope' is not an IPv4 multicast group"),
        ("--port", "70000", "'70000' is not a UDP port, 1 to 65535"),
        ("--port", "nope", "'nope' is not a UDP port, 1 to 65535"),
    ],
)
def test_invalid_multicast_group_is_rejected(capsys, option, value, told):
    with pytest.raises(SystemExit) as end:
        main(["multicast", "send", option, value])
    assert end.value.code == 2
    assert told in capsys.readouterr().err
