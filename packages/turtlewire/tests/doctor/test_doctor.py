"""Findings of the doctor on artificial graphs and traffic."""

import contextlib
import json
import math
import os
import subprocess
import sys
import threading
import time

import pytest
from tests.needs import needs_cyclone_dds
from tests.places import TURTLEWIRE

from turtlewire import Buffer, msg
from turtlewire.cli.main import main
from turtlewire.doctor import examination
from turtlewire.doctor import fast_dds_findings as fast_dds
from turtlewire.doctor import setup_findings as setup
from turtlewire.doctor.finding import Finding
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.network import domains_of, multicast_works, udp_ports
from turtlewire.doctor.setup_findings import network_findings, setup_findings
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener, TfTraffic, frame_names
from turtlewire.errors import InvalidArgumentException, WireError
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire import open_context
from turtlewire.wire.base import EndpointInfo, TypeId
from turtlewire.wire.libddsc import Libddsc, Search
from turtlewire.wire.qos import Durability, QoS, Reliability

STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "1" * 64)
TF = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))
CYCLONE = "rmw_cyclonedds_cpp"
NOW_NS = 1_800_000_000_000_000_000


@pytest.fixture
def context():
    opened = open_context(middleware="local")
    yield opened
    opened.close()


def texts(findings):
    return [finding.text for finding in findings]


@pytest.mark.parametrize(
    ("variable", "value", "is_problem"),
    [
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST", False),
        ("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET", True),
        ("ROS_STATIC_PEERS", "192.0.2.1", True),
    ],
)
def test_an_empty_domain_is_a_problem_where_others_are_looked_for(
    context, monkeypatch, variable, value, is_problem
):
    monkeypatch.setenv(variable, value)
    (finding,) = graph_findings(context.graph)
    assert finding.is_problem == is_problem
    advised = "set ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET on both sides" in finding.remedy
    assert advised != is_problem  # what is set already is no advice


def test_an_empty_domain(context):
    (finding,) = graph_findings(context.graph)
    assert finding.text == f"No nodes found in domain {os.environ['ROS_DOMAIN_ID']} on this host."
    assert "ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET" in finding.remedy


def test_a_sound_graph_has_no_findings(context):
    context.create_node("talker").create_publisher("/chatter", STRING, QoS())
    context.create_node("listener").create_subscription("/chatter", STRING, QoS())
    assert graph_findings(context.graph) == []


def test_servers_that_would_misread_requests(foreign_server):
    foreign_server("/b/reset", "std_srvs/srv/Empty")
    foreign_server("/a/reset", "std_srvs/srv/Empty")
    with contextlib.closing(open_context(middleware="rmw_cyclonedds_cpp")) as context:
        graph = context.graph
        graph.wait_for(
            lambda: [server.node is not None for server in graph.foreign_servers()] == [True, True],
            60_000_000_000,
        )
        (finding,) = graph_findings(graph)
    assert not finding.is_problem
    assert finding.text == (
        "2 services of nodes on a middleware that announces no serviceid cannot be called "
        "from here, including parameters and actions; topics work. Nodes: /stranger."
    )
    assert finding.remedy.startswith("Start the nodes with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp,")


@pytest.mark.parametrize(
    ("variables", "middleware", "told"),
    [
        ({}, CYCLONE, []),
        ({"ROS_DISCOVERY_SERVER": "10.0.0.1:11811"}, CYCLONE, [(True, "are not seen")]),
        ({"ROS_DISCOVERY_SERVER": "10.0.0.1:11811"}, "rmw_zenoh_cpp", []),
        ({"FASTDDS_BUILTIN_TRANSPORTS": "SHM"}, CYCLONE, [(False, "exchange no messages")]),
        ({"FASTDDS_BUILTIN_TRANSPORTS": "LARGE_DATA?max_msg_size=1MB"}, CYCLONE, [(False, "no")]),
        ({"FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}, CYCLONE, []),
    ],
)
def test_variables_that_keep_fast_dds_out_of_reach(variables, middleware, told):
    found = fast_dds.fast_dds_environment(variables, middleware)
    assert [finding.is_problem for finding in found] == [is_problem for is_problem, _ in told]
    assert all(text in finding.text for finding, (_, text) in zip(found, told, strict=True))


class Mixed:
    """A graph with participants on two middlewares."""

    def middlewares(self):
        return {"Fast DDS (rmw_fastrtps_cpp)": 2, "Cyclone DDS (rmw_cyclonedds_cpp)": 1}


def test_participants_are_counted_by_middleware(context):
    (finding,) = fast_dds.fast_dds_findings(Mixed(), {})
    assert finding.text == (
        "The other participants of this domain: 1 on Cyclone DDS (rmw_cyclonedds_cpp), 2 on Fast "
        "DDS (rmw_fastrtps_cpp)."
    )
    assert fast_dds.fast_dds_findings(context.graph, {}) == []


@pytest.mark.parametrize(
    ("reliability", "vendor", "buffer", "is_small"),
    [
        (Reliability.BEST_EFFORT, b"\x01\x0f", 212_992, True),
        (Reliability.BEST_EFFORT, b"\x01\x0f", 4_194_303, True),
        (Reliability.BEST_EFFORT, b"\x01\x0f", 4_194_304, False),
        (Reliability.RELIABLE, b"\x01\x0f", 212_992, False),
        (Reliability.BEST_EFFORT, b"\x01\x10", 212_992, False),
    ],
)
def test_socket_buffers_that_are_too_small_for_images(
    context, monkeypatch, tmp_path, reliability, vendor, buffer, is_small
):
    setting = tmp_path / "rmem_default"
    setting.write_text(f"{buffer}\n")
    monkeypatch.setattr(fast_dds, "_DEFAULT_BUFFER", setting)
    ends = [
        EndpointInfo(kind, "/camera", "sensor_msgs/msg/Image", "", None, gid.ljust(16), qos)
        for kind, gid, qos in (
            ("publisher", b"\x01\x10", QoS()),
            ("subscription", vendor, QoS(reliability=reliability)),
        )
    ]
    found = fast_dds.fast_dds_findings(context.graph, {"/camera": ends})
    assert [f"holds {buffer:,} bytes" in finding.text for finding in found] == [True] * is_small


@pytest.mark.parametrize(("asked", "told"), [({}, True), ({"RMW_IMPLEMENTATION": "local"}, False)])
def test_zenoh_instead_of_cyclone_is_named(asked, told, monkeypatch):
    pytest.importorskip("zenoh")
    monkeypatch.setattr(setup, "find_libddsc", lambda: Search(None, []))
    found = [finding for finding in setup_findings(asked, []) if "Zenoh is used" in finding.text]
    assert [finding.is_problem for finding in found] == [False] * told


@pytest.mark.parametrize(
    ("version", "range_", "peers", "is_blind"),
    [
        ("0.10.2", "LOCALHOST", "", True),
        ("0.10.2", "LOCALHOST", "192.0.2.2", False),
        ("0.10.2", "SUBNET", "", False),
        ("11.0.1", "LOCALHOST", "", False),
    ],
)
def test_a_library_that_does_not_find_fast_dds_is_named(
    monkeypatch, version, range_, peers, is_blind
):
    library = Libddsc("/lib/libddsc.so", version, "the system")
    monkeypatch.setattr(setup, "find_libddsc", lambda: Search(library, []))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", range_)
    monkeypatch.setenv("ROS_STATIC_PEERS", peers)
    blind = [found for found in setup_findings({}, []) if "Fast DDS" in found.text]
    assert len(blind) == is_blind
    assert all("export ROS_STATIC_PEERS=ADDRESS" in found.remedy for found in blind)


def test_nodes_of_one_name(context):
    context.create_node("a")
    context.create_node("a")
    assert texts(graph_findings(context.graph)) == ["2 nodes have the same name /a."]


@pytest.mark.parametrize(("middleware", "matches"), [("local", False), ("rmw_zenoh_cpp", True)])
def test_qos_that_cannot_match_names_both_ends(context, middleware, matches, monkeypatch):
    if matches:
        pytest.importorskip("zenoh")
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    weak = QoS(reliability=Reliability.BEST_EFFORT)
    context.create_node("talker").create_publisher("/x", STRING, weak)
    context.create_node("listener").create_subscription("/x", STRING, QoS())
    reason = "it requests RELIABLE, but the publisher offers BEST_EFFORT"
    expected = [f"/x: /listener receives nothing from /talker: {reason}."]
    assert texts(graph_findings(context.graph)) == ([] if matches else expected)


@pytest.mark.parametrize(
    ("type_id", "text"),
    [
        (
            TypeId("std_msgs/msg/Int32", ""),
            "/x has endpoints of different types: std_msgs/msg/Int32, std_msgs/msg/String.",
        ),
        (
            STRING._replace(type_hash="RIHS01_" + "2" * 64),
            "/x: /listener receives nothing from /talker: their definitions of the type differ.",
        ),
    ],
    ids=["types", "definitions"],
)
def test_types_and_definitions_that_differ(context, type_id, text):
    context.create_node("talker").create_publisher("/x", STRING, QoS())
    context.create_node("listener").create_subscription("/x", type_id, QoS())
    assert texts(graph_findings(context.graph)) == [text]


def transform(parent, child, stamp_ns=NOW_NS):
    message = msg.get_message("geometry_msgs/msg/TransformStamped")(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
    return msg.get_message("tf2_msgs/msg/TFMessage")(transforms=[message])


@pytest.fixture
def broadcasters(context):
    """Two nodes that publish /tf; their gids."""
    return [
        context.create_node(name).create_publisher("/tf", TF, QoS()).gid for name in ("one", "two")
    ]


def traffic_of(*entries):
    traffic = TfTraffic()
    traffic.ended_ns = NOW_NS
    for message, gid, static in entries:
        traffic.note(message, gid, static=static)
    return traffic


#: The messages, each with its sender and whether it is static, and the problems.
TREES = {
    "no fault": (
        [
            (transform("world", "a"), "one", False),
            (transform("world", "b"), "two", False),
            (transform("a", "c", 0), "one", True),
        ],
        [],
    ),
    "two publishers": (
        [(transform("world", "a"), "one", False), (transform("world", "a"), "two", False)],
        ["The frame 'a' is published by /one and /two."],
    ),
    "two parents": (
        [
            (transform("world", "a"), "one", False),
            (transform("map", "a"), "one", False),
            (transform("world", "map"), "one", True),
        ],
        ["The frame 'a' has several parents: map, world."],
    ),
    "separate trees": (
        [(transform("world", "a"), "one", False), (transform("odom", "b"), "one", False)],
        ["The frames form 2 separate trees, with the roots odom, world."],
    ),
    "a loop": (
        [
            (transform("a", "b"), "one", False),
            (transform("b", "a"), "two", False),
            (transform("a", "c"), "two", True),
        ],
        ["The frames form a loop, from child to parent: a -> b -> a."],
    ),
}


@pytest.mark.parametrize(("entries", "problems"), TREES.values(), ids=TREES)
def test_problems_of_trees(context, broadcasters, entries, problems):
    gids = dict(zip(("one", "two"), broadcasters, strict=True))
    traffic = traffic_of(*((message, gids[name], static) for message, name, static in entries))
    assert texts(tf_findings(context.graph, traffic)) == problems


def test_topic_without_publisher(context):
    assert texts(tf_findings(context.graph, TfTraffic())) == ["No node publishes transforms."]


def test_frames_with_and_without_a_slash_are_one(context, broadcasters):
    one, two = broadcasters
    fixed = context.create_node("two").create_publisher("/tf_static", TF, QoS()).gid
    traffic = traffic_of(
        (transform("world", "a"), one, False),
        (transform("/a", "/b"), two, False),
        (transform("/a", "/c", 0), fixed, True),
        (transform("c", "/d"), two, False),
    )
    twins, others = (found for found in tf_findings(context.graph, traffic) if not found.is_problem)
    assert twins.text == (
        "The frames 'a' and 'c' are published with and without a leading slash; the slash is from "
        "/two."
    )
    assert twins.remedy.endswith("see two frames. Publish the names without a slash.")
    assert others.text == (
        "The frames 'b' and 'd' are published with a leading slash; the slash is from /two."
    )
    buffer = Buffer()  # what the remedy says
    for parent, child in (("world", "a"), ("/a", "/b")):
        buffer.set_transform(parent, child, 1, (1.0, 0.0, 0.0))
    assert buffer.lookup_transform("world", "b").translation == (2.0, 0.0, 0.0)
    with pytest.raises(InvalidArgumentException, match="cannot start with a '/'"):
        buffer.lookup_transform("world", "/b")


def test_other_slashes_and_conflicts_of_both_names(context, broadcasters):
    one, two = broadcasters
    traffic = traffic_of(
        (transform("robot/odom", "robot/a"), one, False),
        (transform("robot/odom", "/robot/a"), two, False),
    )
    assert texts(tf_findings(context.graph, traffic)) == [
        "The frame 'robot/a' is published by /one and /two.",
        (
            "The frame 'robot/a' is published with and without a leading slash; the slash is from "
            "/two."
        ),
    ]
    traffic = traffic_of((transform("robot/odom", "a/"), one, False))
    assert tf_findings(context.graph, traffic) == []


def test_mixed_and_stale_times(context, broadcasters):
    one, _ = broadcasters
    old = NOW_NS - 5_000_000_000
    traffic = traffic_of(
        (transform("world", "a", old), one, False),
        (transform("world", "b", 3_000_000_000), one, False),
    )
    assert texts(tf_findings(context.graph, traffic)) == [
        "Wall time and simulated time are mixed: a and b.",
        "The newest transform of 'a' is 5.0 s old.",
    ]


def test_listening_takes_both_topics_and_drops_nonsense(context):
    node = context.create_node("one")
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    static = node.create_publisher("/tf_static", TF, latched)
    dynamic, nonsense = (node.create_publisher("/tf", TF, QoS()) for _ in range(2))
    static.publish(msg.serialize(transform("world", "fixed")))

    def send():
        context.graph.wait_for(lambda: dynamic.subscription_count() > 0)
        nonsense.publish(b"\x00\x01\x00\x00\xff\xff\xff\xff")
        dynamic.publish(msg.serialize(transform("world", "moving")))

    sender = threading.Thread(target=send)
    sender.start()
    listener = TfListener(context)
    listener.wait(60.0, dict.fromkeys((static.gid, dynamic.gid, nonsense.gid), 1))
    sender.join()
    traffic = listener.close()
    assert traffic.parents == {"fixed": {"world"}, "moving": {"world"}}
    assert set(traffic.newest_ns) == {"moving"}
    assert abs(traffic.ended_ns - time.time_ns()) < 60 * 10**9


def hear(context, topic, *messages):
    """Publish messages on a latched topic, and return the traffic."""
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    publisher = context.create_node("one").create_publisher(topic, TF, latched)
    for message in messages:
        publisher.publish(msg.serialize(message))
    listener = TfListener(context)
    listener.wait(60.0, {publisher.gid: len(messages)})
    return listener.close()


def test_refused_transforms_are_a_problem(context):
    broken = transform("world", "arm")
    broken.transforms[0].transform.translation.x = math.nan
    traffic = hear(context, "/tf_static", transform("world", "base"), broken)
    (finding,) = tf_findings(context.graph, traffic)
    assert finding.is_problem
    assert finding.text.startswith(
        "Transforms of 'arm' are refused: TF_NAN_INPUT: Ignoring transform for child_frame_id "
        '"arm" from authority "/one" because of a nan value in the transform (nan 0.000000'
    )


def test_an_empty_message_is_one_that_was_received(context):
    empty = msg.get_message("tf2_msgs/msg/TFMessage")()
    traffic = hear(context, "/tf_static", empty)
    assert tf_findings(context.graph, traffic) == []


class Waits(TfListener):
    """Notes for how long, and for how many messages of whom, it was told to wait."""

    def __init__(self, context):
        super().__init__(context)
        self.asked = []

    def wait(self, seconds, wanted=None):
        self.asked.append((seconds, wanted))


@pytest.mark.parametrize(
    ("topics", "known_at_once"),
    [
        ({"/tf_static": Durability.TRANSIENT_LOCAL}, True),
        ({"/tf_static": Durability.VOLATILE}, False),
        ({"/tf_static": Durability.TRANSIENT_LOCAL, "/tf": Durability.VOLATILE}, False),
        ({}, True),
    ],
)
def test_only_static_publishers_are_known_to_have_said_all(context, topics, known_at_once):
    node = context.create_node("one")
    wanted = {
        node.create_publisher(topic, TF, QoS(durability=durability)).gid: 1
        if durability == Durability.TRANSIENT_LOCAL
        else 50
        for topic, durability in topics.items()
    }
    listener = Waits(context)
    assert listener.gather(context.graph, 2.0) == known_at_once
    assert listener.asked == [(2.0, wanted)]


@pytest.mark.parametrize("parents", [["world"], ["world", "elsewhere"]])
def test_problems_extend_listening_to_the_full_time(context, monkeypatch, parents):
    node = context.create_node("one")
    node.create_publisher("/tf", TF, QoS())
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    static = node.create_publisher("/tf_static", TF, latched)
    message = transform(parents[0], "fixed")
    message.transforms += [transform(parent, "fixed").transforms[0] for parent in parents[1:]]
    static.publish(msg.serialize(message))
    asked = []

    class Hears(TfListener):
        def wait(self, seconds, wanted=None):
            asked.append(wanted)
            super().wait(60.0, {static.gid: 1})

    monkeypatch.setattr("turtlewire.wire.open_context", lambda: context)
    monkeypatch.setattr(examination, "TfListener", Hears)
    examination.examine()
    assert len(asked) == len(parents)
    assert asked[1:] == [None] * (len(parents) - 1)


def test_listening_ends_when_each_publisher_was_heard_often(context, monkeypatch):
    """The time limit is longer than the test's: only the event can end the wait."""
    heard = []
    # A machine that is busy publishes late, which would be a finding, and a reason to go on.
    monkeypatch.setattr(examination, "tf_findings", lambda _, traffic: heard.append(traffic) or [])
    monkeypatch.setattr(examination, "_LISTEN_S", 1000.0)
    monkeypatch.setattr("turtlewire.wire.open_context", lambda: context)
    publisher = context.create_node("one").create_publisher("/tf", TF, QoS())
    end = threading.Event()

    def send():
        with contextlib.suppress(WireError):  # the doctor closes the context
            while not end.wait(0.002):
                publisher.publish(msg.serialize(transform("world", "moving", time.time_ns())))

    sender = threading.Thread(target=send)
    sender.start()
    try:
        examination.examine()
    finally:
        end.set()
        sender.join()
    assert len(heard[0].stamps_ns["moving", publisher.gid]) >= 50


def test_listening_ends_once_all_static_transforms_have_arrived(context, monkeypatch):
    """The time limit is longer than the test's: only the event can end the wait."""
    monkeypatch.setattr(examination, "_LISTEN_S", 1000.0)
    monkeypatch.setattr("turtlewire.wire.open_context", lambda: context)
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    for name in ("one", "two"):
        publisher = context.create_node(name).create_publisher("/tf_static", TF, latched)
        publisher.publish(msg.serialize(transform("world", "shared")))
    assert "The frame 'shared' is published by /one and /two." in texts(examination.examine())


def test_the_transforms_of_a_robot_in_a_namespace(context, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    monkeypatch.setattr("turtlewire.wire.open_context", lambda: context)
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    for name in ("one", "two"):
        node = context.create_node(name, "/robot1")
        node.create_publisher("/robot2/tf", TF, QoS())
        publisher = node.create_publisher("/robot1/tf_static", TF, latched)
        publisher.publish(msg.serialize(transform("world", "shared")))
    (finding,) = tf_findings(context.graph, TfTraffic())
    assert finding.text == (
        "No node publishes transforms on /tf and /tf_static, but on /robot1/tf_static and "
        "/robot2/tf."
    )
    assert "turtlewire doctor --static-topic /robot1/tf_static." in finding.remedy
    found = examination.examine(None, TfTopics("/robot1/tf", "/robot1/tf_static"))
    assert "The frame 'shared' is published by /robot1/one and /robot1/two." in texts(found)


def test_the_options_of_topics(monkeypatch, capsys):
    asked = []
    monkeypatch.setattr(examination, "examine", lambda *given: asked.append(given) or [])
    assert main(["doctor"]) == 0
    assert main(["doctor", "--topic", "r/tf", "--static-topic", "/r/tf_static"]) == 0
    assert asked == [(None, TfTopics()), (None, TfTopics("/r/tf", "/r/tf_static"))]
    with pytest.raises(SystemExit):
        main(["doctor", "--topic", "/a/tf", "--topic", "/b/tf"])
    assert "only for a BAG, --topic and --static-topic may be repeated" in capsys.readouterr().err


def test_completion_offers_frames_without_control_characters(context, monkeypatch):
    monkeypatch.setattr("turtlewire.wire.open_context", lambda: context)
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    publisher = context.create_node("one").create_publisher("/tf_static", TF, latched)
    both = transform("world", "robot")
    both.transforms += transform("world", "rm\x1b[2J").transforms
    publisher.publish(msg.serialize(both))
    assert frame_names() == ["robot", "world"]


def test_a_real_ros_mixed_into_the_path(tmp_path):
    for name in ("ours", "theirs"):
        (tmp_path / name / "rclpy").mkdir(parents=True)
        (tmp_path / name / "rclpy/__init__.py").touch()
    path = [str(tmp_path / "ours"), str(tmp_path / "theirs"), str(tmp_path / "ours")]
    found = [finding for finding in setup_findings({}, path) if finding.is_problem]
    assert len(found) == 1
    assert found[0].text.startswith("Two ROS installations are mixed: rclpy is in ")
    assert not any(finding.is_problem for finding in setup_findings({}, path[:1]))


@pytest.mark.parametrize(
    ("asked", "remedy"), [("", "Install g++"), ("python", "Unset TURTLEWIRE_CORE")]
)
def test_the_plain_core_is_named_with_its_cause(monkeypatch, asked, remedy):
    monkeypatch.setattr("turtlewire.tf.buffer.CORE", "python")
    found = setup_findings({"TURTLEWIRE_CORE": asked}, [])[0]
    assert found.text.startswith("The plain-Python core is in use")
    assert found.remedy.startswith(remedy)


def test_another_distribution_is_named():
    assert "ROS_DISTRO is 'humble', but turtlewire uses the names and texts of jazzy." in texts(
        setup_findings({"ROS_DISTRO": "humble"}, [])
    )


def test_the_command_says_problems_first_and_fails(monkeypatch, capsys):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    network = "middleware local, discovery range LOCALHOST, domain 7."
    findings = [Finding(False, "small", "do a"), *[Finding(True, "big", "do b")] * 2]
    monkeypatch.setattr(examination, "examine", lambda *_: findings)
    assert main(["doctor"]) == 1
    big = "PROBLEM: big\n    do b\n"
    small = "note: small\n    do a\n"
    assert capsys.readouterr().out == f"2 problems found: {network}\n{big}{big}{small}"
    findings.pop()
    assert main(["doctor"]) == 1
    assert capsys.readouterr().out == f"1 problem found: {network}\n{big}{small}"
    findings.pop()
    assert main(["doctor"]) == 0
    assert capsys.readouterr().out == f"All is well: {network}\n{small}"
    findings.clear()
    assert main(["doctor"]) == 0
    assert capsys.readouterr().out == f"All is well: {network}\n"


def test_right_after_the_installation_all_is_well(run):
    """Nothing runs, nothing is sourced and no variable of ROS is set but the test's own domain."""
    variables = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"]}
    variables["ROS_DOMAIN_ID"] = os.environ["ROS_DOMAIN_ID"]
    words = ["env", "-i", *(f"{name}={value}" for name, value in variables.items())]
    program = run(*words, str(TURTLEWIRE), "doctor")
    assert program.wait() == 0, program.text
    first, *others = program.text.splitlines()
    assert first.startswith("All is well: middleware rmw_")
    assert first.endswith(f", discovery range LOCALHOST, domain {variables['ROS_DOMAIN_ID']}.")
    assert not any("PROBLEM" in line for line in others)


def test_without_a_middleware_none_is_named(monkeypatch):
    monkeypatch.setattr(examination, "is_installed", lambda _name: False)
    first, *_ = examination.full_report([Finding(True, "no network", "install one")]).splitlines()
    assert first.startswith("1 problem found: middleware none, ")


def test_findings_as_json(monkeypatch, capsys):
    findings = [Finding(False, "small", "do a"), Finding(True, "big", "do b")]
    monkeypatch.setattr(examination, "examine", lambda *_: findings)
    assert main(["doctor", "--json"]) == 1
    assert json.loads(capsys.readouterr().out) == {
        "findings": [
            {"is_problem": True, "text": "big", "remedy": "do b"},
            {"is_problem": False, "text": "small", "remedy": "do a"},
        ]
    }


def test_names_from_the_wire_do_not_steer_the_terminal():
    text = examination.report([Finding(True, "node /a\x1b[2J", "rename /a\x1b[2J")])
    assert text == "PROBLEM: node /a\\x1b[2J\n    rename /a\\x1b[2J"


def test_a_domain_that_cannot_be_joined_is_a_finding(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "999")
    assert any(
        "ROS_DOMAIN_ID" in text and "999" in text for text in texts(examination.examine(0.0))
    )


def test_stamps_that_jump_back_and_frames_that_leap(context, broadcasters):
    one, _ = broadcasters
    there = transform("world", "a", NOW_NS - 40_000_000)
    there.transforms[0].transform.translation.x = 7.0
    traffic = traffic_of((transform("world", "a"), one, False), (there, one, False))
    assert texts(tf_findings(context.graph, traffic)) == [
        "The stamps of 'a' jump back, by up to 0.040 s.",
        "The frame 'a' leaps by up to 7.0 m between transforms.",
    ]


def test_motion_and_a_change_of_parents_are_no_leaps(context, broadcasters):
    one, _ = broadcasters
    moved = transform("world", "a", NOW_NS + 500_000_000)
    moved.transforms[0].transform.translation.x = 2.0
    elsewhere = transform("map", "a", NOW_NS + 510_000_000)
    traffic = traffic_of(
        (transform("world", "a"), one, False), (moved, one, False), (elsewhere, one, False)
    )
    assert not any("leaps" in text for text in texts(tf_findings(context.graph, traffic)))


def test_the_domains_of_ports():
    # the ports that DDS computes: 7400 + 250 * domain + 10 + 2 * participant (+ 1)
    assert domains_of(
        {7400, 7401, 7410, 7411, 7412 + 250 * 3, 7410 + 250 * 101 + 239, 7410 + 250 * 102, 53}
    ) == {0, 3, 101}


def test_nodes_on_another_domain_of_this_host_are_named(context, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "5")  # the domain of the tests may be any
    monkeypatch.setattr(
        "turtlewire.doctor.network.udp_ports", lambda: {7410 + 250 * 100, 7410 + 250 * 5}
    )
    (finding,) = graph_findings(context.graph)
    assert (
        "This host has nodes in domain 100: export ROS_DOMAIN_ID=100 to see them." in finding.remedy
    )


@needs_cyclone_dds
@pytest.mark.skipif(sys.platform != "linux", reason="the ports in use are read from /proc")
def test_the_ports_of_a_context_are_seen():
    opened = open_context()
    assert int(os.environ["ROS_DOMAIN_ID"]) in domains_of(udp_ports())
    opened.close()


def test_multicast_matters_only_where_others_are_looked_for(monkeypatch):
    monkeypatch.setattr("turtlewire.doctor.setup_findings.multicast_works", lambda: False)
    assert network_findings() == []
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    (finding,) = network_findings()
    assert finding.is_problem
    assert "ROS_STATIC_PEERS" in finding.remedy


def test_multicast_that_does_not_come_back(monkeypatch):
    assert multicast_works(0.01) in (True, False)
    monkeypatch.setattr(
        "turtlewire.doctor.network.GROUP", "127.0.0.1"
    )  # no group: joining it fails as without a network
    assert not multicast_works(0.01)


UP = "ip link set lo up"
OWN_NETWORK = (
    subprocess.run(f"unshare -n {UP}", shell=True, capture_output=True, check=False).returncode == 0
)
LOST = "PROBLEM: A multicast datagram does not come back"
NOBODY = "PROBLEM: No nodes found in domain"
NO_WIRE = "PROBLEM: join domain"


@pytest.mark.skipif(
    not OWN_NETWORK,
    reason="a separate network needs root, unshare and ip (Debian: apt install iproute2)",
)
@pytest.mark.parametrize(
    ("network", "problems"),
    [
        ("true", [LOST, NO_WIRE]),
        (UP, [LOST, NOBODY]),
        (f"{UP} multicast on && ip route add 239.0.0.0/8 dev lo", [NOBODY]),
    ],
    ids=["no interface", "no multicast", "multicast"],
)
def test_the_multicast_of_a_real_network(run, network, problems):
    doctor = f"{network} && {TURTLEWIRE} doctor"
    program = run(
        "unshare", "-n", "sh", "-c", doctor, environment={"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"}
    )
    assert program.wait() == 1
    lines = [line for _, line in program.lines]
    found = [line for line in lines if line.startswith("PROBLEM")]
    assert [line[: len(problem)] for line, problem in zip(found, problems, strict=True)] == problems
    assert all(len(lines[lines.index(line) + 1].strip()) > 20 for line in found)  # the remedy


def test_an_empty_domain_costs_no_listening(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    assert "No node publishes transforms." in texts(examination.examine(1000.0))


@needs_cyclone_dds  # with Zenoh, QoS of any kind match
def test_everything_at_once_on_the_wire(run):
    """All faults of the traffic, from publishers of another process."""
    opened = open_context()
    nodes = {name: opened.create_node(name) for name in ("one", "two")}
    senders = [node.create_publisher("/tf", TF, QoS()) for node in nodes.values()]
    nodes["one"].create_publisher("/x", STRING, QoS(reliability=Reliability.BEST_EFFORT))
    nodes["two"].create_subscription("/x", STRING, QoS())
    program = run(TURTLEWIRE, "doctor", "--listen", "2")
    end = threading.Event()

    def send():
        tick = 0
        while not end.wait(0.02):
            tick += 1
            now = time.time_ns()
            for sender in senders:
                sender.publish(msg.serialize(transform("world", "shared", now)))
            senders[0].publish(msg.serialize(transform("odom", "old", now - 10_000_000_000)))
            senders[0].publish(msg.serialize(transform("odom", "simulated", tick * 20_000_000)))
            leaping = transform("odom", "leaping", now - (tick % 2) * 100_000_000)
            leaping.transforms[0].transform.translation.x = 50.0 * (tick % 2)
            senders[1].publish(msg.serialize(leaping))

    thread = threading.Thread(target=send)
    thread.start()
    try:
        assert program.wait() == 1
    finally:
        end.set()
        thread.join()
        opened.close()
    for text in (
        (
            "PROBLEM: /x: /two receives nothing from /one: it requests RELIABLE, but the "
            "publisher offers BEST_EFFORT."
        ),
        "PROBLEM: The frame 'shared' is published by /one and /two.",
        "PROBLEM: The frames form 2 separate trees, with the roots odom, world.",
        "PROBLEM: Wall time and simulated time are mixed: leaping and simulated.",
        "PROBLEM: The stamps of 'leaping' jump back, by up to 0.0",
        "note: The newest transform of 'old' is 10.",
        "note: The frame 'leaping' leaps by up to 50.0 m between transforms.",
    ):
        assert text in program.text, program.text
    remedies = program.text.splitlines()[2::2]
    assert all(remedy.startswith("    ") for remedy in remedies)
