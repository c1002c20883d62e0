"""Two hosts, played by two network namespaces that are joined by a virtual cable."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
from tests.places import LEARNING

from .hosts import DEMO, PEERS, delete_namespaces, ip, namespace

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not hasattr(os, "geteuid") or os.geteuid() != 0, reason="network namespaces need root"
    ),
    pytest.mark.skipif(
        shutil.which("ip") is None, reason="network namespaces need the command ip (iproute2)"
    ),
]

HOSTS = {"here": "10.77.0.1", "there": "10.77.0.2"}


@pytest.fixture(scope="module")
def hosts() -> Iterator[None]:
    try:
        ip("netns", "add", namespace("here"))
    except subprocess.CalledProcessError as error:
        pytest.skip(f"this container has no network namespaces: {error.stderr.decode().strip()}")
    try:
        ip("netns", "add", namespace("there"))
        ip(
            *("link", "add", "tw-here", "netns", namespace("here")),
            *("type", "veth", "peer", "name", "tw-there", "netns", namespace("there")),
        )
        for host, address in HOSTS.items():
            ip("-n", namespace(host), "addr", "add", f"{address}/24", "dev", f"tw-{host}")
            ip("-n", namespace(host), "link", "set", f"tw-{host}", "up")
            ip("-n", namespace(host), "link", "set", "lo", "up")
        yield
    finally:
        delete_namespaces(*HOSTS)


def command(host: str, script: str) -> list[str]:
    return ["ip", "netns", "exec", namespace(host), sys.executable, str(PEERS / script)]


@contextmanager
def echo_there(**environment: str) -> Iterator[None]:
    peer = subprocess.Popen(
        command("there", "echo.py"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )
    try:
        assert peer.stdout is not None
        assert peer.stdout.readline() == "ready\n"
        yield
    finally:
        peer.communicate()


def probe_here(**environment: str) -> int:
    done = subprocess.run(
        command("here", "probe.py"),
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return int(done.stdout)


@pytest.mark.usefixtures("hosts")
def test_subnet_range_finds_the_other_host():
    with echo_there(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET"):
        assert probe_here(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET") == 1


@pytest.mark.usefixtures("hosts")
@pytest.mark.parametrize("chosen", ["SUBNET", "LOCALHOST"])
def test_static_peers_find_the_other_host_without_multicast(chosen: str):
    with ExitStack() as stack:
        for host in HOSTS:
            link = ("-n", namespace(host), "link", "set", f"tw-{host}", "multicast")
            ip(*link, "off")
            stack.callback(ip, *link, "on")
        stack.enter_context(
            echo_there(ROS_AUTOMATIC_DISCOVERY_RANGE=chosen, ROS_STATIC_PEERS=HOSTS["here"])
        )
        assert (
            probe_here(ROS_AUTOMATIC_DISCOVERY_RANGE=chosen, ROS_STATIC_PEERS=HOSTS["there"]) == 1
        )


@pytest.mark.usefixtures("hosts")
def test_other_hosts_cannot_reach_nodes_by_default():
    """The older process has no range set.

    The younger one, which is found, shows that the older one would have been.
    """
    with ExitStack() as stack:
        stack.enter_context(echo_there(ROS_AUTOMATIC_DISCOVERY_RANGE=""))
        stack.enter_context(echo_there(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET"))
        assert (
            probe_here(ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET", ROS_STATIC_PEERS=HOSTS["there"]) == 1
        )


#: Sends datagrams to each port, and says which are closed: their host answers that by ICMP, but not
#: always, for Linux limits such answers.
KNOCK = """
import socket, sys

for port in map(int, sys.argv[2:]):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as knocking:
        knocking.settimeout(1)
        knocking.connect((sys.argv[1], port))
        for _ in range(60):
            try:
                knocking.send(b"RTPS")
                knocking.recv(1)
            except TimeoutError:
                continue
            except ConnectionRefusedError:
                print("closed")
                break
"""


def sockets_there() -> str:
    """Return the sockets that receive datagrams at the host ``there``."""
    listing = ["ip", "netns", "exec", namespace("there"), "ss", "-Hlun"]
    return subprocess.run(listing, capture_output=True, text=True, check=True).stdout


@pytest.mark.usefixtures("hosts")
@pytest.mark.parametrize("library", ["the wheel's", "Debian's"])
@pytest.mark.parametrize("chosen", ["", "LOCALHOST", "OFF"])
def test_datagrams_from_outside_reach_no_socket_by_default(library: str, chosen: str):
    if library == "Debian's" and not list(Path("/usr/lib").glob("*/libddsc.so.0*")):
        pytest.skip("no libddsc of the system (Debian: apt install libddsc0debian)")
    environment = {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": chosen,
        "CYCLONEDDS_HOME": "/usr" if library == "Debian's" else "",
    }
    with echo_there(**environment):
        sockets = sockets_there()
        ports = re.findall(r" 0\.0\.0\.0%lo:(\d+) ", sockets)
        assert len(ports) == (1 if chosen == "OFF" else 2), sockets
        assert not re.search(r" 0\.0\.0\.0:\d+ ", sockets), sockets
        knock = ["ip", "netns", "exec", namespace("here"), sys.executable, "-c", KNOCK]
        done = subprocess.run(
            [*knock, HOSTS["there"], *ports], capture_output=True, text=True, check=True
        )
        assert done.stdout == "closed\n" * len(ports)


@pytest.mark.usefixtures("hosts")
@pytest.mark.parametrize(
    "environment",
    [
        {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"},
        {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_STATIC_PEERS": HOSTS["here"]},
        {
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "CYCLONEDDS_URI": "<General><Interfaces><NetworkInterface name='tw-there'/>"
            "</Interfaces></General>",
        },
    ],
    ids=["subnet", "static peers", "CYCLONEDDS_URI"],
)
def test_the_sockets_of_wider_ranges_hear_all_interfaces(environment: dict[str, str]):
    with echo_there(**environment):
        sockets = sockets_there()
        assert re.search(r" 0\.0\.0\.0:\d+ ", sockets)
        assert "%lo" not in sockets


@pytest.mark.usefixtures("hosts")
@pytest.mark.parametrize(
    ("chosen", "override", "outcome"),
    [
        ("", "", "nobody came"),
        ("LOCALHOST", "", "nobody came"),
        ("LOCALHOST", f'scouting/multicast/interface="{HOSTS["there"]}"', "connected"),
    ],
    ids=["default", "LOCALHOST", "an interface named"],
)
def test_zenoh_follows_no_call_from_outside_by_default(chosen: str, override: str, outcome: str):
    pytest.importorskip("zenoh", reason="needs Zenoh (pip install 'turtlewire[zenoh]')")
    environment = {
        "RMW_IMPLEMENTATION": "rmw_zenoh_cpp",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": chosen,
        "ZENOH_CONFIG_OVERRIDE": override,
    }
    with echo_there(**environment):
        ports = re.findall(r" 0\.0\.0\.0(?:%lo)?:(\d+) ", sockets_there())
        assert ports
        intruder = [*command("here", "zenoh_intruder.py"), HOSTS["here"], HOSTS["there"], *ports]
        done = subprocess.run(intruder, capture_output=True, text=True, check=True)
    assert done.stdout == f"{outcome}\n"


class Asker:
    """The peer ``asker.py`` on the host ``here``."""

    def __init__(self, errors: Path, **environment: str) -> None:
        with errors.open("w") as file:
            self.process = subprocess.Popen(
                command("here", "asker.py"),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=file,
                text=True,
                env=os.environ | environment,
            )

    def ask(self, text: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(text + "\n")
        self.process.stdin.flush()

    def wait_for(self, line: str) -> None:
        assert self.process.stdout is not None
        for said in self.process.stdout:
            if said == line + "\n":
                return
        raise AssertionError(f"it ended before it said {line!r}")


@pytest.fixture
def link() -> Iterator[Callable[[str], None]]:
    """Takes the cable at the host ``here`` down and up."""
    yield lambda state: ip("-n", namespace("here"), "link", "set", "tw-here", state)
    ip("-n", namespace("here"), "link", "set", "tw-here", "up")


@pytest.mark.usefixtures("hosts")
@pytest.mark.parametrize(
    "lease", ["60s", "6s"], ids=["shorter than the lease", "longer than the lease"]
)
def test_link_down_and_up_is_named_once_and_messages_resume(link, lease: str, tmp_path: Path):
    environment = {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
        "CYCLONEDDS_URI": f"<Discovery><LeaseDuration>{lease}</LeaseDuration></Discovery>",
    }
    with echo_there(**environment):
        asker = Asker(tmp_path / "errors", **environment)
        asker.wait_for("peers 1 1")
        asker.ask("before")
        asker.wait_for("before")
        link("down")
        asker.ask("meanwhile")
        if lease == "6s":
            asker.wait_for("peers 0 0")
            link("up")
            asker.wait_for("peers 1 1")
        else:
            link("up")
            asker.wait_for("meanwhile")
        asker.ask("after")
        asker.wait_for("after")
        asker.process.communicate()
    assert asker.process.returncode == 0
    errors = (tmp_path / "errors").read_text().splitlines()
    assert len(errors) == 1, errors
    assert "the network rejects packets to" in errors[0]


@pytest.fixture
def split_demo(tmp_path) -> Iterator[list[subprocess.Popen[bytes]]]:
    """The follow demo, two of its nodes on each host."""
    environment = os.environ | {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
        "PYTHONPATH": str(LEARNING),
        "TURTLEWIRE_PORT": "0",
        "TURTLEWIRE_BROWSER": "0",
    }
    processes = []
    try:
        for number, (host, module, arguments) in enumerate(DEMO):
            program = f"from {module} import main; main()"
            run = [
                "ip",
                "netns",
                "exec",
                namespace(host),
                sys.executable,
                "-c",
                program,
                "--ros-args",
                *arguments,
            ]
            with (tmp_path / f"{number}.txt").open("wb") as output:
                processes.append(
                    subprocess.Popen(run, env=environment, stdout=output, stderr=subprocess.STDOUT)
                )
        yield processes
    finally:
        for process in processes:
            process.send_signal(signal.SIGINT)
        for process in processes:
            process.wait(60)


@pytest.mark.usefixtures("hosts")
def test_the_follow_demo_runs_split_over_both_hosts(split_demo, tmp_path):
    run = command("here", "follow.py")
    environment = os.environ | {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}
    done = subprocess.run(
        run, env=environment, capture_output=True, text=True, timeout=840, check=False
    )
    said = "".join(path.read_text() for path in sorted(tmp_path.glob("*.txt")))
    assert done.returncode == 0, done.stderr + said
    way_of_turtle2, final_distance = (float(word) for word in done.stdout.split())
    assert way_of_turtle2 > 1.5
    assert final_distance <= 0.3
    assert all(process.poll() is None for process in split_demo), said
    assert "Traceback" not in said
