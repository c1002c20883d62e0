"""An MCAP file of JSON or Protobuf is not opened as if it were empty: its channels are named."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import pytest

import turtlewire
from ros2cli.main import main as ros2
from rosbag2_py import PlayOptions, SequentialReader
from rosbag2_transport.play_filter import mistakes, played_topics
from turtlewire.bag import open_bag
from turtlewire.bag.encodings import is_cdr, not_in_cdr
from turtlewire.bag.metadata import TopicInfo
from turtlewire.cli.main import main
from turtlewire.errors import BagError, InterfaceError
from turtlewire_view.bag_source import BagSource

NAMED = (
    "Not in ROS 2's encoding, CDR, and therefore neither decoded nor shown: "
    "/log (protobuf foxglove.Log), /pose (json demo.Pose)."
)


@pytest.fixture
def foreign(tmp_path):
    return written(tmp_path / "foreign.mcap")


def written(path, **types):
    """An MCAP file as programs write it that are not of ROS."""
    writer_module = pytest.importorskip("mcap.writer", reason="pip install mcap")
    with path.open("wb") as file:
        writer = writer_module.Writer(file)
        writer.start("", "test")
        for topic, encoding, kind in (
            ("/pose", "json", "demo.Pose"),
            ("/log", "protobuf", "foxglove.Log"),
            *((f"/{name}", "json", kind) for name, kind in types.items()),
        ):
            schema = writer.register_schema(kind, "jsonschema", b"{}")
            channel = writer.register_channel(topic, encoding, schema)
            writer.add_message(channel, log_time=10**18, publish_time=1, data=b'{"x": 1}')
        writer.finish()
    return str(path)


def test_the_sentence_names_topics_encodings_and_types():
    topics = [TopicInfo("/a", "x.A", "json"), TopicInfo("/b", "std_msgs/msg/String")]
    assert [is_cdr(topic) for topic in topics] == [False, True]
    assert not_in_cdr(topics).endswith(": /a (json x.A).")
    assert not_in_cdr(topics[1:]) == ""
    assert not_in_cdr([TopicInfo("/c", "", ""), TopicInfo("/b", "", "cdr")]).endswith(
        "Without a type in the bag, and therefore neither decoded nor shown: /b, /c."
    )
    many = [TopicInfo(f"/t{number:02}", "x", "json") for number in range(12)]
    assert not_in_cdr(many).endswith("/t09 (json x) and 2 more.")
    assert not_in_cdr(many[:10]).endswith("/t09 (json x).")


def test_the_bytes_are_read_and_decoding_says_why_not(foreign):
    with open_bag(foreign) as bag:
        message = next(bag.messages("/pose"))
        assert (message.data, bag.topics["/pose"].serialization_format) == (b'{"x": 1}', "json")
        with pytest.raises(
            InterfaceError, match=r"/pose: 'demo\.Pose' is not a type of ROS 2"
        ) as e:
            message.decode()
    assert "its messages are in json" in str(e.value)


def test_the_doctor_names_them(foreign, capsys):
    assert main(["doctor", foreign]) == 0
    assert NAMED in capsys.readouterr().out


def test_transforms_are_missed_with_the_reason(foreign, tmp_path, capsys):
    with pytest.raises(BagError, match="none of the topics") as caught:
        turtlewire.Buffer.from_bag(foreign)
    assert NAMED in caught.value.hint
    assert main(["bag", "tf", foreign]) == 2
    assert NAMED in capsys.readouterr().err
    other = written(tmp_path / "other.mcap", tf="tf2_msgs/msg/TFMessage")
    with pytest.raises(BagError, match="no transforms that can be read") as caught:
        turtlewire.Buffer.from_bag(other)
    assert "/tf (json tf2_msgs/msg/TFMessage)" in caught.value.hint


def test_ros2_bag_info_keeps_its_text_and_says_more_on_stderr(foreign, capsys):
    assert ros2(["bag", "info", foreign]) in (0, None)
    out, err = capsys.readouterr()
    assert "Topic: /pose | Type: demo.Pose | Count: 1 | Serialization Format: json" in out
    assert err == f"{NAMED}\n"
    assert NAMED not in out


def test_a_reader_warns(foreign, capfd):
    SequentialReader().open_uri(foreign)
    assert f"[rosbag2_storage]: {NAMED}" in capfd.readouterr().err


def test_the_view_says_what_it_does_not_show(tmp_path):
    source = BagSource(written(tmp_path / "x.mcap", tf="tf2_msgs/msg/TFMessage"))
    try:
        assert source.topics() == []
        assert "/tf (json tf2_msgs/msg/TFMessage)" in source.problem
    finally:
        source.close()


def test_a_player_names_them_once_and_plays_the_rest(tmp_path):
    path = written(tmp_path / "x.mcap")
    with open_bag(path) as foreign_bag:
        topics = {**foreign_bag.topics, "/text": TopicInfo("/text", "std_msgs/msg/String")}
        bag = SimpleNamespace(topics=topics, start_ns=0, end_ns=1)
        assert played_topics(bag, PlayOptions()) == ["/text"]
        (warning,) = mistakes(bag, PlayOptions())
        assert warning == NAMED.replace("neither decoded nor shown", "not played")
        assert mistakes(bag, PlayOptions(topics_to_filter=["/text"])) == []
        (warning,) = mistakes(bag, PlayOptions(topics_to_filter=["/pose"]))
        assert warning.endswith("not played: /pose (json demo.Pose).")


def test_ros2_bag_play_warns_and_goes_on(foreign, run):
    program = "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))"
    player = run(sys.executable, "-c", program, "bag", "play", foreign)
    assert player.wait() == 0, player.text
    assert (
        player.text.count("not played: /log (protobuf foxglove.Log), /pose (json demo.Pose).") == 1
    )
    assert "[ERROR]" not in player.text
