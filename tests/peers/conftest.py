"""Real ROS 2 nodes on Fast DDS beside ours; `scripts/peers` installs them."""

import os
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from tests.places import BIN, ROOT

from turtlewire.wire import open_context

PEER = Path(__file__).with_name("peer.py")
SERVER = Path(__file__).with_name("server.py")
LONG = 60_000_000_000

#: A node takes 700 MB of address space; one that misreads a request takes all that it can get.
ADDRESS_SPACE_KB = 4_000_000


@pytest.fixture(scope="module", params=["jazzy", "kilted"])
def venv(request):
    """The virtual environment of a real ROS 2 distribution."""
    folder = ROOT / "build" / "peers" / request.param
    if not (folder / "installed.txt").exists():
        pytest.skip(f"no real ROS 2 {request.param} in build/peers (run scripts/peers)")
    return folder


@pytest.fixture
def real(venv, run):
    """Starts `peer.py` or another program in this domain, with its address space limited."""
    nodes, before = [], shared_memory()

    def start(*arguments, program=PEER, **environment):
        kept = ("HOME", "ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE")
        variables = {key: os.environ[key] for key in kept} | {"PATH": "/usr/bin:/bin"}
        pairs = [f"{key}={value}" for key, value in (variables | environment).items()]
        limited = f'ulimit -v {ADDRESS_SPACE_KB}; exec env -i "$@"'
        python = venv / "bin" / "python"
        nodes.append(run("sh", "-c", limited, "sh", *pairs, python, program, *arguments))
        return nodes[-1]

    yield start
    for node in nodes:
        node.process.kill()
        node.wait()
    for path in shared_memory() - before - in_use():
        path.unlink(missing_ok=True)


def shared_memory():
    """The files through which nodes on Fast DDS share memory; a process that is killed leaves them.

    One that ends leaves some as well.
    """
    return set(Path("/dev/shm").glob("*fast*"))


def in_use():
    """The files that a process has open or mapped, among them nodes of others on this computer."""
    found = set()
    for process in Path("/proc").glob("[0-9]*"):
        # A file is opened, then mapped, then closed: looked for in this order, none is missed.
        with suppress(OSError):  # the process has ended, or is somebody else's
            for file in (process / "fd").iterdir():
                with suppress(FileNotFoundError):  # closed since
                    found.add(file.readlink())
            lines = (process / "maps").read_text().splitlines()
            found |= {Path(line.split(maxsplit=5)[-1]) for line in lines if "/dev/shm/" in line}
    return found


@pytest.fixture
def context():
    opened = open_context(middleware="rmw_cyclonedds_cpp")
    yield opened
    opened.close()


@pytest.fixture
def start_peer(real, context):
    """Starts the node /peer, and waits until our graph knows it and all its endpoints."""

    def start(**environment):
        node, graph = real("node", **environment), context.graph
        graph.hurry()
        assert graph.wait_for(
            lambda: any(found.name == "peer" for found in graph.nodes()) and graph.is_complete(),
            LONG,
        ), node.text
        return node

    return start


@pytest.fixture
def peer(start_peer):
    """The node /peer."""
    return start_peer()


@pytest.fixture
def command(run, venv, tmp_path):
    """Runs a command of ours to its end: its exit status and output."""
    # The classes of test_msgs, made of the definitions in the real environment.
    for kind, maker, name in (
        ("srv", "get_service", "BasicTypes"),
        ("action", "get_action", "Fibonacci"),
    ):
        package = tmp_path / "test_msgs" / kind
        package.mkdir(parents=True)
        (package / "__init__.py").write_text(
            f'from turtlewire.msg import {maker}\n{name} = {maker}("test_msgs/{kind}/{name}")\n'
        )
    environment = {
        "AMENT_PREFIX_PATH": str(venv),
        "PYTHONPATH": str(tmp_path),
        "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp",
    }

    def call(program, *words, **more):
        started = run(BIN / program, *words, environment=environment | more)
        return started.wait(), started.text

    return call


@pytest.fixture
def serve(run, venv):
    """Starts the node /ours with the same services as /peer."""

    def start(**environment):
        ours = {"AMENT_PREFIX_PATH": str(venv), "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}
        program = run(sys.executable, SERVER, environment=ours | environment)
        program.wait_for("up")
        return program

    return start
