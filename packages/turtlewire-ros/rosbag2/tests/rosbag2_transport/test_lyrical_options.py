"""Options of `ros2 bag` that Lyrical added, and one that it dropped."""

import argparse
import time

import pytest
from tests.programs import lines_in

from rclpy.qos import DurabilityPolicy, QoSProfile
from ros2bag.verb import record
from ros2cli.main import main
from rosbag2_interfaces import srv
from rosbag2_transport.record import read_static_topics
from std_msgs.msg import String
from turtlewire.bag import BagWriter, open_bag
from turtlewire.bag.recording import Recording

from .conftest import end, texts

KIND = "std_msgs/msg/String"


@pytest.fixture
def bag(tmp_path):
    with BagWriter(tmp_path / "recorded") as writer:
        writer.add_topic("/chat", KIND)
        writer.append("/chat", b"\0\1\0\0\2\0\0\0a\0", 1, 1)
    return tmp_path / "recorded"


def converted(tmp_path, inputs):
    """Run the verb with a file of inputs; returns its status."""
    (tmp_path / "in.yaml").write_text(inputs)
    (tmp_path / "out.yaml").write_text(f"output_bags:\n- uri: {tmp_path / 'new'}\n  all: true\n")
    files = ("--input-options", str(tmp_path / "in.yaml"), "-o", str(tmp_path / "out.yaml"))
    return main(["bag", "convert", *files])


def test_a_file_names_the_bags_to_convert(bag, tmp_path):
    assert converted(tmp_path, f"input_bags:\n- uri: {bag}\n  storage_id: mcap\n") == 0
    with open_bag(tmp_path / "new") as new:
        assert [message.decode().data for message in new.messages("/chat")] == ["a"]


@pytest.mark.parametrize(
    ("inputs", "told"),
    [
        ("output_bags: []", "the key 'input_bags' with a list is missing."),
        ("input_bags: [{storage_id: mcap}]", "each bag needs the key 'uri'."),
        ("input_bags: [{uri: x, storge_id: mcap}]", "unknown key 'storge_id'\nDid you mean: "),
        ("input_bags: [{uri: x, max_cache_size: a}]", "max_cache_size is of type int, not 'a'"),
    ],
)
def test_wrong_files_of_inputs(tmp_path, capsys, inputs, told):
    assert converted(tmp_path, inputs) == 1
    assert told in capsys.readouterr().err


def test_inputs_are_named_once(bag, capsys):
    with pytest.raises(SystemExit):
        main(["bag", "convert", "--input-options", __file__, "-o", "x", "-i", str(bag)])
    assert "not allowed with argument" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["bag", "convert", "-o", "x"])
    text = "one of the arguments -i/--input --input-options is required"
    assert text in capsys.readouterr().err


def test_topics_without_their_option_are_gone_in_lyrical():
    program = """
from ros2cli.main import make_parser
words = ["bag", "record", "/chat"]
print(make_parser(words).parse_known_args(words)[1])
"""
    assert lines_in("kilted", program) == ["[]"]
    assert lines_in("lyrical", program) == ["['/chat']"]


def test_the_oldest_files_are_removed(tmp_path):
    with BagWriter(tmp_path / "bag", max_file_ns=10, max_files=2) as writer:
        writer.add_topic("/chat", KIND)
        for time_ns in range(100):
            writer.write("/chat", b"\0\1\0\0\1\0\0\0\0", time_ns)
    names = sorted(path.name for path in (tmp_path / "bag").glob("*.mcap"))
    assert len(names) == 2
    with open_bag(tmp_path / "bag") as bag:
        times = [message.log_time_ns for message in bag.messages()]
        assert sorted(bag.metadata.paths) == names
        assert bag.metadata.message_count == bag.topics["/chat"].message_count == len(times)
    assert times == list(range(times[0], 100))
    assert 11 < len(times) < 23
    # Numbers go on, so that no file takes the name of another one.
    assert names == ["bag_8.mcap", "bag_9.mcap"]


def test_static_topics_are_recorded_before_they_have_a_publisher(bag_verb, peer, tmp_path):
    topics = f"static_topics_and_types_list:\n- [/later, {KIND}]\n"
    (tmp_path / "topics.yaml").write_text(topics)
    recorder = bag_verb("record", "--static-topics-path", "topics.yaml", "-o", "bag")
    recorder.wait_for("Subscribed to topic '/later'")
    publisher = peer.heard(peer.publisher("/later"))
    publisher.publish(String(data="hello"))
    assert publisher.wait_for_all_acked()
    assert end(recorder) == 0
    assert texts(tmp_path / "bag", "/later") == ["hello"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("topics: []", "the key 'static_topics_and_types_list' with a list is missing."),
        ("static_topics_and_types_list: [/a]", "'/a' is not a topic and its type."),
        ("static_topics_and_types_list: [[/a, 3]]", "['/a', 3] is not a topic and its type."),
        ("static_topics_and_types_list: [[a, b/msg/C]]", "'a' cannot be the name of a topic: "),
        ("{", "cannot read the topics in "),
    ],
)
def test_wrong_files_of_static_topics(tmp_path, text, told):
    (tmp_path / "topics.yaml").write_text(text)
    with pytest.raises(RuntimeError) as caught:
        read_static_topics(str(tmp_path / "topics.yaml"))
    assert told in str(caught.value)


LATCHED = b"\0\1\0\0\2\0\0\0"


def latched(letter):
    return LATCHED + letter + b"\0"


def contents(folder):
    """Topics, texts and times of the messages of each file, in the order of the files."""
    found = []
    for number in range(len(list(folder.glob("bag_*")))):
        with open_bag(next(folder.glob(f"bag_{number}.*"))) as bag:
            messages = list(bag.messages())
        found.append([f"{m.topic} {m.decode().data} {m.log_time_ns}" for m in messages])
    return found


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_latched_messages_are_repeated_in_further_files(tmp_path, storage):
    writer = BagWriter(tmp_path / "bag", storage=storage, max_file_ns=10)
    recording = Recording(writer)
    for topic in ("/map", "/chat"):
        recording.add_topic(topic, KIND)
    recording.repeat("/map", 2)
    for letter, time_ns in ((b"a", 1), (b"b", 2), (b"c", 3)):
        recording.write("/map", latched(letter), time_ns)
    recording.write("/chat", latched(b"x"), 20)
    recording.write("/map", latched(b"d"), 40)
    recording.split()
    recording.close()
    assert contents(tmp_path / "bag") == [
        ["/map a 1", "/map b 2", "/map c 3"],
        ["/map b 20", "/map c 20", "/chat x 20"],
        ["/map b 40", "/map c 40", "/map d 40"],
        ["/map c 40", "/map d 40"],
    ]


def test_latched_messages_are_repeated_in_snapshots(tmp_path):
    recording = Recording(BagWriter(tmp_path / "bag"), cache_bytes=30, snapshot=True)
    for topic in ("/map", "/chat"):
        recording.add_topic(topic, KIND)
    recording.repeat("/map", 2)
    for letter, time_ns in ((b"a", 1), (b"b", 2), (b"c", 3)):
        recording.write("/map", latched(letter), time_ns)  # ten bytes each
    assert recording.take_snapshot()
    for time_ns in (4, 5):
        recording.write("/chat", latched(b"x"), time_ns)
    recording.write("/map", latched(b"d"), 6)
    recording.write("/chat", latched(b"x"), 7)  # pushes the first out
    assert recording.take_snapshot()
    recording.close()
    assert contents(tmp_path / "bag") == [
        [*("/map a 1", "/map b 2", "/map c 3"), *("/map c 5", "/chat x 5", "/map d 6", "/chat x 7")]
    ]


def test_a_recorder_repeats_latched_topics(bag_verb, peer, tmp_path):
    recorder = bag_verb(
        *("record", "--topics", "/map", "/chat", "-o", "bag"),
        *("--repeat-transient-local", "/map", "/chat=2"),
    )
    recorder.wait_for("Recording...")
    latched_publisher = peer.publisher(
        "/map", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    )
    latched_publisher.publish(String(data="m"))
    publisher = peer.heard(peer.publisher("/chat"))
    recorder.wait_for("Subscribed to topic '/map'")
    recorder.wait_for("Topic '/chat' is not transient local: its messages are not repeated")
    publisher.publish(String(data="x"))
    # An acknowledged message may not be written yet, and a file has no event to wait for.
    limit = time.monotonic() + 60
    while len(contents(tmp_path / "bag")[0]) < 2 and time.monotonic() < limit:
        time.sleep(0.01)
    assert peer.call(srv.SplitBagfile, "/rosbag2_recorder/split_bagfile") is not None
    assert end(recorder) == 0
    files = [[line.rpartition(" ")[0] for line in lines] for lines in contents(tmp_path / "bag")]
    assert [sorted(lines) for lines in files] == [["/chat x", "/map m"], ["/map m"]]


@pytest.mark.parametrize(
    ("words", "depths"), [([], {}), (["/a", "b=3", "/c=1"], {"/a": 1, "/b": 3, "/c": 1})]
)
def test_depths_of_repeated_topics(words, depths):
    assert record.parse_repeat_transient_local_topics(words) == depths


@pytest.mark.parametrize("word", ["/a=0", "/a=x", "/a=", "=1", "/a=-1"])
def test_wrong_depths_of_repeated_topics(word, capsys):
    assert main(["bag", "record", "--all", "--repeat-transient-local", word]) == 1
    assert f"with a depth from 1, not '{word}'" in capsys.readouterr().err


def test_options_of_a_recorder_for_other_programs():
    parser = argparse.ArgumentParser()
    record.add_recorder_arguments(parser)
    args = parser.parse_args(["--repeat-all-transient-local"])
    assert args.repeat_all_transient_local == 1
    assert not record.check_necessary_argument(args)
    assert "Need to specify" in record.validate_parsed_arguments(args, None)
    args = parser.parse_args(["--all", "--repeat-all-transient-local", "4"])
    assert record._record_options(args).repeat_all_transient_local_depth == 4
    assert record.validate_parsed_arguments(args, "new") is None
    assert "already exists" in record.validate_parsed_arguments(args, ".")
