"""The environment variables of discovery, and what Cyclone is told."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import xml.etree.ElementTree as ET
from importlib.util import find_spec

import pytest

from tests import programs
from turtlewire.errors import WireError
from turtlewire.wire import environment, open_context, report
from turtlewire.wire.cyclone import library as dds
from turtlewire.wire.cyclone.configuration import domain_configuration
from turtlewire.wire.environment import Discovery, Range, leaving_at_once

VARIABLES = [
    "ROS_DOMAIN_ID",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_STATIC_PEERS",
    "ROS_LOCALHOST_ONLY",
    "CYCLONEDDS_URI",
]
OWN_DOMAIN = os.environ["ROS_DOMAIN_ID"]
HAS_WHEEL = find_spec("cyclonedds") is not None
TRACEBACKS_HAVE_HINTS = sys.version_info >= (3, 11)  # as notes


@pytest.fixture(autouse=True)
def clean(monkeypatch: pytest.MonkeyPatch):
    for variable in VARIABLES:
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setattr(report, "_said", set())


def run_python(code: str, **variables: str) -> subprocess.CompletedProcess[str]:
    return programs.run_python(code, check=False, timeout=300, env=os.environ | variables)


def test_domain_id(monkeypatch: pytest.MonkeyPatch):
    assert environment.domain_id() == 0
    monkeypatch.setenv("ROS_DOMAIN_ID", "42")
    assert environment.domain_id() == 42
    monkeypatch.setenv("ROS_DOMAIN_ID", "232")
    assert environment.domain_id() == 232
    monkeypatch.setenv("ROS_DOMAIN_ID", "0042")
    assert environment.domain_id() == 42


@pytest.mark.parametrize("text", ["233", "-1", "seven", "1.5", "٣", 5000 * "1"])
def test_a_bad_domain_id_is_named(monkeypatch: pytest.MonkeyPatch, text: str):
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    with pytest.raises(
        WireError, match="ROS_DOMAIN_ID is not an integral number from 0 to 232"
    ) as caught:
        environment.domain_id()
    assert text in str(caught.value)


def test_the_range_is_localhost_unless_said_otherwise(monkeypatch: pytest.MonkeyPatch):
    assert environment.discovery() == Discovery(Range.LOCALHOST, ())
    monkeypatch.setenv("ROS_STATIC_PEERS", "10.0.0.1; robot.local;")
    for name in ("SUBNET", "OFF", "SYSTEM_DEFAULT", "LOCALHOST"):
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", name)
        assert environment.discovery() == Discovery(Range[name], ("10.0.0.1", "robot.local"))


def test_an_invalid_range_warns_once_and_is_localhost(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "UNIVERSE")
    assert environment.discovery().range == Range.LOCALHOST
    assert environment.discovery().range == Range.LOCALHOST
    assert capsys.readouterr().err.count("UNIVERSE") == 1


def test_localhost_only_is_honoured_and_deprecated(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    monkeypatch.setenv("ROS_LOCALHOST_ONLY", "1")
    assert environment.discovery() == Discovery(Range.LOCALHOST, ())
    assert "ROS_LOCALHOST_ONLY is deprecated" in capsys.readouterr().err
    monkeypatch.setenv("ROS_LOCALHOST_ONLY", "0")
    assert environment.discovery().range == Range.SUBNET


@pytest.mark.parametrize("theirs", ["rmw_fastrtps_cpp", "rmw_connextdds", "rmw_nope"])
def test_a_middleware_that_is_not_here_is_one_line_and_cyclone_is_taken(theirs: str):
    """Runs in a separate process, because this one may have printed the warning already."""
    code = (
        "from turtlewire.wire import open_context\n"
        "for _ in range(2):\n"
        "    context = open_context(5)\n"
        "    print(type(context).__name__)\n"
        "    context.close()\n"
    )
    done = run_python(code, RMW_IMPLEMENTATION=theirs)
    assert (done.returncode, done.stdout.split()) == (0, ["CycloneContext", "CycloneContext"])
    [line] = done.stderr.splitlines()
    assert f"RMW_IMPLEMENTATION is {theirs}, which is not available here" in line


@pytest.mark.parametrize(
    ("asked", "missing", "taken", "said"),
    [
        ("rmw_zenoh_cpp", "zenoh", "CycloneContext", "pip install 'turtlewire[zenoh]'"),
        ("", "cyclonedds", "ZenohContext", ""),  # the set-up and the doctor say so
        ("rmw_zenoh_cpp", "", "ZenohContext", ""),
    ],
)
def test_missing_middleware_is_reported_and_replaced(asked, missing, taken, said):
    if taken == "CycloneContext" and not HAS_WHEEL:
        pytest.skip("needs the cyclonedds wheel")
    code = (
        "import importlib.util\n"
        "find_spec = importlib.util.find_spec\n"
        "importlib.util.find_spec = "
        f"lambda name: None if name == {missing!r} else find_spec(name)\n"
        "from turtlewire.wire import libddsc, open_context\n"
        "libddsc._SYSTEM = ()\n"
        "context = open_context(5)\n"
        "print(type(context).__name__)\n"
        "context.close()\n"
    )
    done = run_python(code, RMW_IMPLEMENTATION=asked)
    assert (done.returncode, done.stdout.split()) == (0, [taken])
    assert len(done.stderr.splitlines()) == bool(said)
    assert said in done.stderr


def test_a_folder_named_zenoh_is_no_middleware(tmp_path, monkeypatch: pytest.MonkeyPatch):
    (tmp_path / "zenoh").mkdir()
    monkeypatch.setattr(sys, "path", [str(tmp_path)])
    monkeypatch.delitem(sys.modules, "zenoh", raising=False)
    assert not environment.is_installed("rmw_zenoh_cpp")


def configuration(discovery: Discovery) -> ET.Element:
    domain = ET.fromstring(domain_configuration(7, discovery)).find("Domain")
    assert domain is not None
    return domain


def peers(domain: ET.Element) -> list[str | None]:
    return [peer.get("address") for peer in domain.iter("Peer")]


def interfaces(domain: ET.Element) -> list[dict[str, str]]:
    return [interface.attrib for interface in domain.iter("NetworkInterface")]


def test_immediate_exit_does_not_wait_for_acknowledgements():
    here = Discovery(Range.LOCALHOST, ())
    with leaving_at_once():
        assert configuration(here).findtext("Internal/WriterLingerDuration") == "0 s"
    assert configuration(here).find("Internal/WriterLingerDuration") is None


def test_localhost_uses_nothing_but_the_loopback_interface():
    loopback = {"address": "127.0.0.1"}
    assert interfaces(configuration(Discovery(Range.LOCALHOST, ()))) == [loopback]
    assert interfaces(configuration(Discovery(Range.LOCALHOST, ("10.0.0.1",)))) == []
    for ignored in ((), ("10.0.0.1",)):
        assert interfaces(configuration(Discovery(Range.OFF, ignored))) == [loopback]
    assert interfaces(configuration(Discovery(Range.SUBNET, ()))) == []


def test_datagrams_are_large_on_loopback_only():
    def largest(*discovery) -> str | None:
        return configuration(Discovery(*discovery)).findtext("General/MaxMessageSize")

    assert largest(Range.LOCALHOST, ()) == largest(Range.OFF, ()) == "65500B"
    assert largest(Range.LOCALHOST, ("10.0.0.1",)) is largest(Range.SUBNET, ()) is None
    local = configuration(Discovery(Range.LOCALHOST, ()))
    assert local.findtext("General/FragmentSize") == "64000B"


def test_configuration_of_each_range():
    local = configuration(Discovery(Range.LOCALHOST, ("10.0.0.1",)))
    assert local.findtext("General/AllowMulticast") == "false"
    assert local.findtext("Discovery/MaxAutoParticipantIndex") == "120"
    assert peers(local) == ["127.0.0.1", "10.0.0.1"]
    subnet = configuration(Discovery(Range.SUBNET, ("10.0.0.1",)))
    assert subnet.findtext("General/AllowMulticast") is None
    assert peers(subnet) == ["10.0.0.1"]
    assert peers(configuration(Discovery(Range.SYSTEM_DEFAULT, ("10.0.0.1",)))) == []
    off = configuration(Discovery(Range.OFF, ()))
    assert off.findtext("General/AllowMulticast") == "false"
    assert off.findtext("Discovery/Tag") == f"ros_discovery_off_{os.getpid()}"


@pytest.mark.parametrize("chosen", Range)
def test_every_range_leaves_heartbeats_and_enlarges_buffers(chosen: Range):
    domain = configuration(Discovery(chosen, ()))
    # Rarer heartbeats made `ros2 node list` beside 50 processes take 2.9 s instead of 0.5 s.
    assert domain.find("Internal/HeartbeatInterval") is None
    assert [buffer.attrib for buffer in domain.iter("SocketReceiveBufferSize")] == [
        {"max": "10 MB"}
    ]
    # Fast DDS gets the keys of endpoints that end.
    assert domain.findtext("Internal/GenerateKeyhash") == "true"
    # Of the types that Fast DDS describes, Cyclone misreads some, and drops their endpoints.
    vendors = domain.findtext("Compatibility/IgnoreTypeInformation")
    assert vendors == ("1.15" if dds.ABI.ignores_types else None)


def test_the_users_configuration_comes_last(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("CYCLONEDDS_URI", "file:///my.xml")
    assert domain_configuration(7, Discovery(Range.SUBNET, ())).endswith(
        "</CycloneDDS>,file:///my.xml"
    )


@pytest.mark.parametrize("peer", ["127.0.0.1:0", "127.0.0.1:65536", "::1", "a b", 'a"/><b'])
def test_a_static_peer_must_be_an_address(peer: str):
    with pytest.raises(WireError, match=f"ROS_STATIC_PEERS: {peer!r} is not an address"):
        domain_configuration(7, Discovery(Range.SUBNET, (peer,)))


def test_static_peers_are_resolved():
    assert peers(configuration(Discovery(Range.SUBNET, ("localhost", "localhost:7410")))) == [
        "127.0.0.1",
        "127.0.0.1:7410",
    ]


def test_a_static_peer_that_nobody_knows_is_left_out_with_one_warning(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    def nobody(*_: object) -> None:
        raise socket.gaierror(socket.EAI_NONAME, "Name or service not known")

    monkeypatch.setattr(socket, "getaddrinfo", nobody)
    for _ in range(2):
        assert peers(configuration(Discovery(Range.LOCALHOST, ("robot",)))) == ["127.0.0.1"]
    [line] = capsys.readouterr().err.splitlines()
    assert line.endswith(
        "ROS_STATIC_PEERS: robot is ignored, it has no IPv4 address: Name or service not known"
    )


@pytest.mark.parametrize("peer", ["a..b", "0.0.0.0"])  # no name server is asked for these
def test_static_peer_fatal_to_cyclone_is_skipped_with_a_warning(peer: str):
    """Runs in a separate process, which must survive."""
    code = (
        "from turtlewire.wire import open_context; open_context().close(); "
        "open_context().close(); print('alive')"
    )
    done = run_python(code, ROS_STATIC_PEERS=f"{peer};localhost", ROS_DOMAIN_ID=OWN_DOMAIN)
    assert (done.returncode, done.stdout) == (0, "alive\n")
    [line] = done.stderr.splitlines()
    assert f"ROS_STATIC_PEERS: {peer} is ignored" in line


@pytest.mark.parametrize("chosen", ["LOCALHOST", "SUBNET", "OFF", "SYSTEM_DEFAULT"])
def test_cyclone_accepts_the_configuration_of_each_range(chosen: str):
    code = (
        "from turtlewire.wire import open_context; c = open_context(); c.create_node('n'); "
        "print(len(c.graph.nodes())); c.close()"
    )
    if chosen in {"SUBNET", "SYSTEM_DEFAULT"} and not HAS_WHEEL:
        pytest.skip("Cyclone DDS 0.10 warns of an interface without multicast")
    done = run_python(code, ROS_AUTOMATIC_DISCOVERY_RANGE=chosen, ROS_DOMAIN_ID=OWN_DOMAIN)
    assert (done.returncode, done.stdout, done.stderr) == (0, "1\n", "")


def test_a_broken_configuration_of_the_user_is_one_clear_error():
    code = "from turtlewire.wire import open_context; open_context()"
    done = run_python(code, CYCLONEDDS_URI="<Nonsense>")
    assert done.returncode == 1
    assert "WireError: join domain" in done.stderr
    assert (
        "Cyclone DDS says config: //CycloneDDS/Domain: Nonsense: unknown element" in done.stderr
        or sys.platform == "win32"
    )
    assert "CYCLONEDDS_URI is set" in done.stderr or not TRACEBACKS_HAVE_HINTS


def test_a_domain_that_is_full_says_so():
    """Configured for one process, with a neighbour that is there already."""
    code = (
        "from turtlewire.wire.cyclone import participant; participant.max_processes = lambda _: 1\n"
    )
    code += "from turtlewire.wire import open_context; c = open_context()\n"
    code += "print('there', flush=True); input()"
    limit = "<Discovery><MaxAutoParticipantIndex>1</MaxAutoParticipantIndex></Discovery>"
    variables = os.environ | {"ROS_DOMAIN_ID": OWN_DOMAIN, "CYCLONEDDS_URI": limit}
    command = [sys.executable, "-c", code]
    with subprocess.Popen(
        command, env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as neighbour:
        assert neighbour.stdout is not None
        neighbour.stdout.readline()  # nothing, if the one place is taken already
        done = subprocess.run(
            command, env=variables, capture_output=True, text=True, timeout=300, check=False
        )
        neighbour.communicate(b"\n")
    assert done.returncode == 1
    assert f"WireError: join domain {OWN_DOMAIN}" in done.stderr
    said = re.search(r"in the domain: \d+; it holds 1\.", done.stderr)
    assert said or sys.platform != "linux" or not TRACEBACKS_HAVE_HINTS


def test_the_last_domain_works():
    code = (
        "from turtlewire.wire import open_context; c = open_context(232); c.create_node('n'); "
        "print(len(c.graph.nodes())); c.close()"
    )
    done = run_python(code)
    assert (done.stdout, done.stderr) == ("1\n", "")


def test_a_platform_without_cyclone_gets_one_clear_line():
    code = (
        "import importlib.util\nimportlib.util.find_spec = lambda name: None\nfrom "
        "turtlewire.wire import libddsc, open_context\nlibddsc._SYSTEM = ()\nopen_context()\n"
    )
    done = run_python(code)
    assert "WireError: Cyclone DDS is not available for Python" in done.stderr
    assert "use Zenoh: pip install 'turtlewire[zenoh]'" in done.stderr or sys.version_info < (3, 11)


@pytest.mark.parametrize("domain_id", [-1, 233])
def test_a_domain_out_of_range_is_refused(domain_id: int):
    with pytest.raises(WireError, match=f"domain {domain_id} does not exist"):
        open_context(domain_id)
