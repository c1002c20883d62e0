"""Programs on other vendors' DDS exchange messages with ours, both ways.

C on Debian's Cyclone DDS, C++ on Debian's Fast DDS.
"""

from __future__ import annotations

import os
import shutil
import subprocess
from contextlib import contextmanager
from pathlib import Path

import pytest
from tests.places import ROS2

from turtlewire import msg
from turtlewire.errors import CdrError
from turtlewire.wire import open_context, report
from turtlewire.wire.base import Context, TypeId
from turtlewire.wire.cyclone.silent_peers import SilentPeers
from turtlewire.wire.qos import Durability, QoS

pytestmark = pytest.mark.slow

PEERS = Path(__file__).parent / "peers"
LONG = 60_000_000_000
LATCHED = QoS(depth=100, durability=Durability.TRANSIENT_LOCAL)
LIVE = QoS(depth=100)
#: What a real rmw_cyclonedds tells Cyclone in LOCALHOST range.
RMW_CYCLONEDDS_LOCALHOST = (
    "<General><AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    '<Peers><Peer address="localhost"/></Peers></Discovery>'
)
TYPES = {
    "tf": "tf2_msgs/msg/TFMessage",
    "pose": "turtlesim/msg/Pose",
    "twist": "geometry_msgs/msg/Twist",
}
NEEDED = {
    "c": (["gcc", "idlc"], "/usr/include/dds/dds.h", "cyclonedds-dev and cyclonedds-tools"),
    "fast": (["g++"], "/usr/include/fastdds/dds/domain/DomainParticipant.hpp", "libfastrtps-dev"),
}


def build(vendor: str, folder: Path) -> Path:
    """Compile the peer; skips where its libraries are missing."""
    tools, header, packages = NEEDED[vendor]
    if not all(map(shutil.which, tools)) or not Path(header).exists():
        pytest.skip(f"needs {' and '.join(tools)} and the packages {packages}")
    program = folder / "peer"
    if vendor == "c":
        subprocess.run(["idlc", PEERS / "cyclone" / "ros.idl"], cwd=folder, check=True)
        subprocess.run(
            [
                "gcc",
                "-Wall",
                "-Wextra",
                "-I.",
                "-o",
                program,
                PEERS / "cyclone" / "peer.c",
                "ros.c",
                "-lddsc",
            ],
            cwd=folder,
            check=True,
        )
    else:
        source = PEERS / "fastdds" / "peer.cpp"
        subprocess.run(
            [
                "g++",
                "-std=c++20",
                "-Wall",
                "-Wextra",
                "-o",
                program,
                source,
                "-lfastrtps",
                "-lfastcdr",
            ],
            check=True,
        )
    return program


@pytest.fixture(scope="module", params=["c", "fast"])
def vendor(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(scope="module")
def program(vendor: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(vendor, tmp_path_factory.mktemp(vendor))


@contextmanager
def running(program: Path, context: Context | None, *arguments: str):
    environment = os.environ | {"CYCLONEDDS_URI": RMW_CYCLONEDDS_LOCALHOST}
    domain_id = environment["ROS_DOMAIN_ID"] if context is None else str(context.domain_id)
    peer = subprocess.Popen([program, domain_id, *arguments], env=environment)
    try:
        yield
        assert peer.poll() is None, "the peer ended too early"
    finally:
        peer.terminate()
        peer.wait()


def type_id(name: str) -> TypeId:
    return TypeId(TYPES[name], msg.type_hash(TYPES[name]))


def take(context: Context, subscription, count: int = 1) -> list:
    wait_set = context.create_wait_set()
    wait_set.attach(subscription)
    taken: list = []
    while len(taken) < count:
        assert wait_set.wait(LONG) == [subscription]
        taken += [data for data, _ in subscription.take()]
    wait_set.close()
    return taken


def example(name: str, number: float):
    """A message, and what the peer makes of it: 1 more in one number."""
    message = msg.get_message(TYPES[name])()
    if name == "tf":
        for frame in ("turtle1", "räder/links"):
            transform = msg.get_message("geometry_msgs/msg/TransformStamped")()
            transform.header.frame_id, transform.child_frame_id = "world", frame
            transform.header.stamp.sec, transform.header.stamp.nanosec = 12, 345678901
            transform.transform.translation.x, transform.transform.rotation.z = number, 0.5
            message.transforms.append(transform)
    elif name == "pose":
        message.x, message.theta, message.angular_velocity = number, 0.5, -2.0
    else:
        message.linear.x, message.angular.z = number, 0.5
    return message


@pytest.mark.parametrize("name", TYPES)
def test_messages_go_both_ways(program: Path, vendor: str, context: Context, name: str):
    node = context.create_node("ours")
    publisher = node.create_publisher(f"/to_{vendor}/{name}", type_id(name), LIVE)
    # Latched: the peer may answer before its writer has heard of our reader.
    subscription = node.create_subscription(f"/from_{vendor}/{name}", type_id(name), LATCHED)
    with running(program, context):
        assert context.graph.wait_for(
            lambda: publisher.subscription_count() == 1 and subscription.publisher_count() == 1,
            LONG,
        )
        for number in range(20):
            publisher.publish(msg.serialize(example(name, float(number))))
        received = [
            msg.deserialize(msg.get_message(TYPES[name]), data)
            for data in take(context, subscription, 20)
        ]
    assert received == [example(name, number + 1.0) for number in range(20)]


@pytest.mark.parametrize("name", TYPES)
def test_late_joiners_receive_what_is_latched(
    program: Path, vendor: str, context: Context, name: str
):
    node = context.create_node("ours")
    latched = node.create_publisher(f"/latched/{name}", type_id(name), LATCHED)
    latched.publish(msg.serialize(example(name, 5.0)))
    with running(program, context):
        answer = node.create_subscription(f"/from_{vendor}/{name}", type_id(name), LATCHED)
        assert msg.deserialize(msg.get_message(TYPES[name]), take(context, answer)[0]) == example(
            name, 6.0
        )
        theirs = node.create_subscription(f"/latched_{vendor}/{name}", type_id(name), LATCHED)
        message = msg.deserialize(msg.get_message(TYPES[name]), take(context, theirs)[0])
    if name == "tf":
        [transform] = message.transforms
        assert (
            transform.header.frame_id,
            transform.header.stamp.sec,
            transform.transform.translation.x,
        ) == ("world", 3, 1.5)
    else:
        assert (message.x if name == "pose" else message.linear.x) == 1.5


def test_the_graph_shows_endpoints_that_no_node_claims(
    program: Path, vendor: str, context: Context
):
    graph = context.graph
    with running(program, context):
        topic = f"/latched_{vendor}/pose"
        assert graph.wait_for(lambda: topic in graph.topic_names_and_types(), LONG)
        [endpoint] = [endpoint for endpoint in graph.endpoints() if endpoint.topic == topic]
        assert (endpoint.kind, endpoint.type_name, endpoint.type_hash, endpoint.node) == (
            "publisher",
            TYPES["pose"],
            "",
            None,
        )
        assert endpoint.qos.durability == Durability.TRANSIENT_LOCAL
        assert graph.nodes() == []


@pytest.mark.parametrize("vendor", ["fast"], indirect=True)  # Cyclone DDS refuses to send them
def test_payloads_that_are_no_messages_are_dropped_and_said_once(
    program: Path, context: Context, capfd, monkeypatch
):
    monkeypatch.setattr(report, "_said", set())
    string = msg.get_message("std_msgs/msg/String")
    identity = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
    received: list[str] = []
    errors = 0
    subscription = context.create_node("ours").create_subscription("/broken", identity, LATCHED)
    with running(program, context):
        while "good" not in received:
            for data in take(context, subscription):
                try:
                    received.append(msg.deserialize(string, data).data)
                except CdrError:
                    errors += 1
    assert received == ["good"]
    # The big-endian message has a little-endian header, so its string seems far too long.
    assert errors == 2
    assert capfd.readouterr().err.count("dropped a message on /broken") == 1


@pytest.mark.parametrize("vendor", ["fast"], indirect=True)
def test_the_first_question_for_nodes_has_the_node_of_fast_dds(program: Path, context: Context):
    graph = context.graph
    for name in (f"fast_node_{number}" for number in range(5)):
        with running(program, context, name):
            assert graph.wait_for(lambda: name in {node.name for node in graph.nodes()}, LONG)  # noqa: B023
            listed = subprocess.run(
                [ROS2, "node", "list"], capture_output=True, text=True, check=True
            )
        assert listed.stdout.split() == [f"/{name}"]


@pytest.mark.parametrize("vendor", ["fast"], indirect=True)
def test_hurried_commands_query_fast_dds(program: Path, monkeypatch):
    asked = []
    ask = SilentPeers.ask
    monkeypatch.setattr(
        SilentPeers, "ask", lambda self, questions: (asked.append(questions), ask(self, questions))
    )
    with running(program, None, "fast_node"):
        for _ in range(5):  # one whose first words are heard need not be asked
            context = open_context(middleware="rmw_cyclonedds_cpp")
            assert _becomes_complete(context)
            context.close()
    assert any(questions.endpoints for questions in asked)
    assert any(questions.nodes for questions in asked)


def _becomes_complete(context: Context) -> bool:
    graph = context.graph
    graph.hurry()
    return graph.wait_for(lambda: graph.nodes() and graph.is_complete(), LONG)
