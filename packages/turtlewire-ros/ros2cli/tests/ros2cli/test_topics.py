"""`ros2 topic echo` and `ros2 topic pub --yaml-file`, and QoS on the command line."""

import argparse
import functools
from types import SimpleNamespace

import pytest
from tests.programs import ROS2, lines_in

import rclpy
from geometry_msgs.msg import PointStamped
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future
from ros2cli.main import main, make_parser
from ros2cli.node.strategy import NodeStrategy
from ros2cli.qos import add_qos_arguments, choose_qos
from ros2topic.verb.echo import _field, _Printer, make_filter
from std_msgs.msg import String
from turtlewire.msg import get_message


def test_fields_by_names_and_indices():
    message = get_message("tf2_msgs/msg/TFMessage")(
        transforms=[get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="a")]
    )
    assert _field(message, "transforms[0].child_frame_id") == "a"
    assert _field(message, "transforms.[0].child_frame_id") == "a"


@pytest.mark.parametrize("path", ["nope", "transforms[3]", "transforms.x"])
def test_fields_that_are_not_there(path):
    with pytest.raises(RuntimeError, match=r"^Invalid field '.*': "):
        _field(get_message("tf2_msgs/msg/TFMessage")(), path)


def test_filters():
    keep = make_filter("m.data > 3")
    assert keep(get_message("std_msgs/msg/Int32")(data=4))
    assert not keep(get_message("std_msgs/msg/Int32")(data=3))
    assert make_filter(None) is None
    with pytest.raises(RuntimeError, match="Invalid filter expression"):
        make_filter("m.data >")


INFO = {"source_timestamp": 1, "received_timestamp": 2, "publication_sequence_number": None}


def printer(*options):
    words = ["topic", "echo", "/x", *options]
    return _Printer(make_parser(words).parse_args(words), None, Future())


class FakeNode:
    """Makes a timer that counts how often it was set back."""

    def __init__(self):
        self.resets = 0

    def create_timer(self, period, end):
        self.period, self.end = period, end
        return self

    def reset(self):
        self.resets += 1


def test_each_message_puts_the_end_off(capsys):
    node, shown = FakeNode(), printer("--timeout", "7")
    shown.end_after_silence(SimpleNamespace(node=node))
    assert node.period == 7
    for _ in range(2):
        shown.show(get_message("std_msgs/msg/Int32")(data=4), INFO)
    assert node.resets == 2
    node.end()
    shown.show(get_message("std_msgs/msg/Int32")(data=5), INFO)
    assert node.resets == 2
    assert capsys.readouterr().out == "data: 4\n---\n" * 2


@pytest.mark.parametrize(
    ("options", "message", "expected"),
    [
        (
            (),
            get_message("std_msgs/msg/Int32")(data=4),
            (
                "publication_sequence_number: null\nreceived_timestamp: 2\nsource_timestamp: 1\n"
                "---\ndata: 4\n---\n"
            ),
        ),
        (("--csv",), get_message("std_msgs/msg/Int32")(data=4), "1,2,None,4\n"),
        (
            ("--raw",),
            b"\x00\x01",
            (
                f"---Got new message, message info:---\n{INFO}\n---Message data:---\n"
                "b'\\x00\\x01'\n---\n"
            ),
        ),
    ],
    ids=["yaml", "csv", "raw"],
)
def test_message_infos_have_the_formats_of_ros_2(capsys, options, message, expected):
    printer("-i", *options).show(message, INFO)
    assert capsys.readouterr().out == expected


def test_several_fields_of_a_message(capsys):
    message = get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="a")
    shown = printer("--field", "child_frame_id", "--field", "transform.translation", "-i")
    shown.show(message, INFO)
    told = f"---Got new message, message info:---\n{INFO}\n---Message data:---\n"
    assert capsys.readouterr().out == f"{told}a\nx: 0.0\ny: 0.0\nz: 0.0\n---\n"
    shown = printer("--field", "transform.translation", "--field", "child_frame_id", "--csv")
    shown.show(message, INFO)
    assert capsys.readouterr().out == "0.0,0.0,0.0\na\n"


def test_the_terminal_is_cleared_before_each_message(capsys):
    shown = printer("--clear")
    for number in (4, 5):
        shown.show(get_message("std_msgs/msg/Int32")(data=number), INFO)
    clear = "\x1b[H\x1b[2J"
    assert capsys.readouterr().out == f"{clear}data: 4\n---\n{clear}data: 5\n---\n"


def test_the_name_of_the_node_and_escaped_text_after_clearing(run):
    with rclpy.init(args=[]) as context:
        node = rclpy.create_node("talker")
        publisher = node.create_publisher(String, "chatter", 1)
        echo = run(*ROS2, "topic", "echo", "/chatter", "-c", "--node-name", "listener", "--once")
        ears = functools.partial(node.get_subscriptions_info_by_topic, "/chatter")
        assert context.wait_for_graph(
            lambda: [ear.node_name for ear in ears()] == ["listener"], 60_000_000_000
        )
        assert publisher.get_subscription_count() == 1
        publisher.publish(String(data="\x1b[2J"))
        assert echo.wait() == 0
    assert echo.text == '\x1b[H\x1b[2Jdata: "\\e[2J"\n---'


def test_a_wrong_one_of_several_fields_is_rejected(capsys):
    words = ("/chatter", "std_msgs/msg/String", "--field", "data", "--field", "date")
    assert main(["topic", "echo", *words]) == 1
    assert capsys.readouterr().err == (
        "Invalid field 'date': 'String' object has no attribute 'date'\nDid you mean: data\n"
    )


# `ros2 topic pub --yaml-file` with a subscription.


#: As `ros2 topic echo` prints it, with `---` after the last message.
DOCUMENTS = """\
header: {stamp: now, frame_id: a}
---
point: {x: 2.0}
---
point: {x: 3.0}
---
"""
UNKNOWN_FIELD = "'PointStamped' object has no attribute 'points'\nDid you mean: point"
KIND = "geometry_msgs/msg/PointStamped"


@pytest.fixture
def heard():
    """A function that waits for three messages on /points, at most for seconds."""
    with rclpy.init(args=[]):
        node, messages = rclpy.create_node("listener"), []
        done = rclpy.task.Future()

        def hear(message):
            messages.append(message)
            if len(messages) == 3:
                done.set_result(None)

        node.create_subscription(PointStamped, "points", hear, 10)

        def wait(seconds):
            rclpy.spin_until_future_complete(node, done, timeout_sec=seconds)
            return messages

        yield wait


def test_each_document_is_a_message(run, tmp_path, heard):
    (tmp_path / "points.yaml").write_text(DOCUMENTS)
    words = ("--yaml-file", tmp_path / "points.yaml", "-r", "50", "-w", "1")
    pub = run(*ROS2, "topic", "pub", "/points", KIND, *words)
    first, second, third = heard(60)
    assert pub.wait() == 0
    assert (first.header.frame_id, second.point.x, third.point.x) == ("a", 2.0, 3.0)
    assert first.header.stamp.sec > 0 == second.header.stamp.sec
    assert [line[:14] for line in pub.text.splitlines() if "publishing" in line] == [
        "publishing #1:",
        "publishing #2:",
        "publishing #3:",
    ]


@pytest.mark.parametrize(("option", "count"), [("--once", 1), ("-t2", 2), ("-t9", 3)])
def test_no_more_messages_than_asked_for(run, tmp_path, option, count):
    (tmp_path / "points.yaml").write_text(DOCUMENTS)
    words = ("--yaml-file", tmp_path / "points.yaml", "-r", "50", "-w", "0", option)
    pub = run(*ROS2, "topic", "pub", "/points", KIND, *words)
    assert pub.wait() == 0
    assert pub.text.count("publishing #") == count


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (None, "Cannot read '{}': No such file or directory\n"),
        ("", "The file '{}' holds no YAML document\n"),
        ("point: {}\n---\n[1]", "The passed value needs to be a dictionary in YAML format\n"),
        ("point: {}\n---\npoints: {}", f"Failed to populate field: {UNKNOWN_FIELD}\n"),
    ],
    ids=["missing", "empty", "list", "field"],
)
def test_wrong_files_are_rejected_before_anything_is_sent(capsys, tmp_path, text, told):
    path = tmp_path / "points.yaml"
    if text is not None:
        path.write_text(text)
    assert main(["topic", "pub", "/points", KIND, "--yaml-file", str(path)]) == 1
    assert capsys.readouterr() == ("", told.format(path))


def test_values_and_a_file_exclude_each_other(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "pub", "/points", KIND, "{}", "--yaml-file", "points.yaml"])
    assert end.value.code == 2
    assert "argument --yaml-file: not allowed with argument values" in capsys.readouterr().err


# QoS on the command lines of extensions.


@pytest.fixture
def parser():
    parser = argparse.ArgumentParser()
    add_qos_arguments(parser, "subscribe", "sensor_data", " and more")
    return parser


def test_the_chosen_profile(parser):
    assert "QoS to subscribe with (default: sensor_data) and more" in parser.format_help()
    with NodeStrategy(None, node_name="chooser") as node:
        assert node.get_name() == "chooser"
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_publisher(String, "/latched", latched)
        matching = choose_qos(node, "/latched", parser.parse_args([]))
        assert matching.durability == DurabilityPolicy.TRANSIENT_LOCAL
        assert matching.reliability == ReliabilityPolicy.RELIABLE
        asked = choose_qos(node.node, "/latched", parser.parse_args(["--qos-depth", "3"]))
        assert (asked.depth, asked.reliability) == (3, ReliabilityPolicy.BEST_EFFORT)


@pytest.mark.parametrize("as_json", [False, True])
def test_different_publishers_are_reported_outside_of_json(parser, capsys, as_json):
    with NodeStrategy(None, node_name="chooser") as node:
        for policy in ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT:
            node.create_publisher(String, "/mixed", QoSProfile(depth=1, reliability=policy))
        chosen = choose_qos(node, "/mixed", argparse.Namespace(json=as_json))
    assert chosen.reliability == ReliabilityPolicy.BEST_EFFORT
    told = capsys.readouterr()
    assert "offering QoSReliabilityPolicy.RELIABLE. " in (told.err if as_json else told.out)
    assert (told.out if as_json else told.err) == ""


def test_the_parameters_of_ros2topic_follow_the_distribution():
    program = "import inspect; from ros2topic.api import add_qos_arguments as each; "
    program += "print(*inspect.signature(each).parameters)"
    assert lines_in("jazzy", program) == ["parser subscribe_or_publish default_profile_str"]
    later = ["parser entity_type default_profile_str extra_message"]
    assert lines_in("kilted", program) == later
