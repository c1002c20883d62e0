"""`ros2 multicast`: one datagram from a sender to a receiver."""

from __future__ import annotations

import socket
import sys

import pytest

from ros2cli.main import main

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)


@pytest.fixture
def _multicast():
    """Skips on a host that no interface joins to a multicast group."""
    group = socket.inet_aton("225.0.0.1") + socket.inet_aton("0.0.0.0")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        except OSError as error:
            pytest.skip(f"no interface of this host takes part in multicast: {error}")


@pytest.mark.usefixtures("_multicast")
def test_a_datagram_arrives(run, capsys):
    receiver = run(*ROS2, "multicast", "receive", "--port", "49151")
    receiver.wait_for(r"^Waiting for UDP multicast datagram\.\.\.$")
    assert main(["multicast", "send", "--port", "49151", "--ttl", "0"]) == 0  # not beyond this host
    assert capsys.readouterr().out == "Sending one UDP multicast datagram...\n"
    receiver.wait_for(r"^Received from [0-9.]+:\d+: 'Hello World!'$")
    assert receiver.wait() == 0


@pytest.mark.parametrize(
    ("option", "value", "told"),
    [
        (
            "--group",
            "127.0.0.1",
            "'127.0.0.1' is no IPv4 multicast group; those are 224.0.0.0 to 239.255.255.255",
        ),
        ("--group", "nope", "'nope' is no IPv4 multicast group"),
        ("--port", "70000", "'70000' is no UDP port; those are 1 to 65535"),
    ],
)
def test_what_is_no_group_is_refused(capsys, option, value, told):
    with pytest.raises(SystemExit) as end:
        main(["multicast", "send", option, value])
    assert end.value.code == 2
    assert told in capsys.readouterr().err
