"""Fields and filters of `ros2 topic echo`."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from rclpy.task import Future
from ros2cli.main import make_parser
from ros2topic.verb.echo import _field, _Printer, make_filter
from turtlewire.msg import get_message


def test_fields_by_names_and_indices():
    message = get_message("tf2_msgs/msg/TFMessage")(
        transforms=[get_message("geometry_msgs/msg/TransformStamped")(child_frame_id="a")]
    )
    assert _field(message, "transforms[0].child_frame_id") == "a"
    assert _field(message, None) is message


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
