"""Fields and filters of `ros2 topic echo`."""

import functools
import sys
from types import SimpleNamespace

import pytest

import rclpy
from rclpy.task import Future
from ros2cli.main import main, make_parser
from ros2topic.verb.echo import _field, _Printer, make_filter
from std_msgs.msg import String
from turtlewire.msg import get_message

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)


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
