"""Every option of `ros2 bag play`: words, names that the bag does not have, clocks, requests."""

import argparse
import dataclasses
import signal

import pytest
from tests.places import GOLDEN

import rosbag2_py
from example_interfaces.srv import AddTwoInts
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from ros2bag.verb import burst, play
from ros2cli.arguments import add_arguments
from rosbag2_interfaces import srv
from rosbag2_py import MessageOrder, PlayOptions, ServiceRequestsSource, StorageOptions
from rosbag2_transport.play_filter import mistakes
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage
from turtlewire.bag import BagWriter, open_bag
from turtlewire.msg import get_message
from turtlewire.wire.qos import Reliability

from .conftest import LATCHED, ROS2, end, texts

SMALL = GOLDEN / "bag" / "p_small"
SECOND = 1_000_000_000
START = 1_800_000_000 * SECOND  # of the small bag
EVENT = "example_interfaces/srv/AddTwoInts_Event"
LOSSY = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("", {}),
        ("--read-ahead-queue-size 5", {"read_ahead_queue_size": 5}),
        ("-r 2.5", {"rate": 2.5}),
        ("--topics /a /b", {"topics_to_filter": ["/a", "/b"]}),
        ("--services /add sub", {"services_to_filter": ["/add", "/sub"]}),
        ("-e x -x y", {"regex_to_filter": "x", "exclude_regex_to_filter": "y"}),
        ("--exclude-topics /a", {"exclude_topics_to_filter": ["/a"]}),
        ("--exclude-services /add", {"exclude_service_events_to_filter": ["/add"]}),
        ("-l", {"loop": True}),
        ("--message-order sent", {"message_order": MessageOrder.SENT_TIMESTAMP}),
        ("-m /a:=/b", {"topic_remapping_options": ["--ros-args", "--remap", "/a:=/b"]}),
        ("--clock", {"clock_publish_frequency": 40}),
        ("--clock 3", {"clock_publish_frequency": 3}),
        ("--clock-topics /a /b", {"clock_trigger_topics": ["/a", "/b"]}),
        ("--clock-topics-all", {"clock_publish_on_topic_publish": True}),
        ("-d 1.5", {"delay": 1.5}),
        ("--playback-duration 3", {"playback_duration": 3.0}),
        ("--playback-until-sec 1.5", {"playback_until_timestamp": 1_500_000_000}),
        ("--playback-until-nsec 15", {"playback_until_timestamp": 15}),
        ("--disable-keyboard-controls", {"disable_keyboard_controls": True}),
        ("-p", {"start_paused": True}),
        ("--start-offset 2", {"start_offset": 2.0}),
        ("--progress-bar-update-rate -1", {"progress_bar_update_rate": -1}),
        ("--progress-bar-separation-lines 0", {"progress_bar_separation_lines": 0}),
        ("--wait-for-all-acked 0", {"wait_acked_timeout": 0}),
        ("--disable-loan-message", {}),
        ("--publish-service-requests", {"publish_service_requests": True}),
        (
            "--service-requests-source client_introspection",
            {"service_requests_source": ServiceRequestsSource.CLIENT_INTROSPECTION},
        ),
    ],
)
def test_words_become_options(words, expected):
    parser = argparse.ArgumentParser()
    add_arguments(parser, play.ARGUMENTS)
    options = play._play_options(parser.parse_args([str(SMALL), *words.split()]))
    found = {
        field.name: value
        for field in dataclasses.fields(PlayOptions)
        if (value := getattr(options, field.name)) != getattr(PlayOptions(), field.name)
    }
    for name in ("services_to_filter", "exclude_service_events_to_filter"):
        if name in expected:
            expected = {name: [f"{service}/_service_event" for service in expected[name]]}
    assert found == expected


@pytest.mark.parametrize("verb", [play, burst])
@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("x", "x is not the valid type (float)"),
        *((text, f"{text} is not in the valid range (>= 0.0)") for text in ("nan", "-1", "-inf")),
        *(
            (each, f"{each} is not in the valid range (<= 9223372036.0)")
            for each in ("inf", "1e10")
        ),
    ],
)
def test_a_start_offset_is_a_number_of_seconds_from_zero(capsys, verb, text, wrong):
    parser = argparse.ArgumentParser()
    add_arguments(parser, verb.ARGUMENTS)
    with pytest.raises(SystemExit, match="2"):
        parser.parse_args([str(SMALL), f"--start-offset={text}"])
    assert capsys.readouterr().err.endswith(f": error: argument --start-offset: {wrong}\n")


@pytest.mark.parametrize("option", ["--playback-duration", "--playback-until-sec"])
@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("x", "invalid float value: 'x'"),
        *(
            (each, f"{each} is not in the valid range (<= 9223372036.0)")
            for each in ("nan", "inf", "1e10")
        ),
    ],
)
def test_limits_that_are_no_times_are_rejected(capsys, option, text, wrong):
    parser = argparse.ArgumentParser()
    add_arguments(parser, play.ARGUMENTS)
    assert parser.parse_args([str(SMALL), option, "9223372036"])
    with pytest.raises(SystemExit, match="2"):
        parser.parse_args([str(SMALL), option, text])
    assert capsys.readouterr().err.endswith(f": error: argument {option}: {wrong}\n")


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"topics_to_filter": ["/a"]}, ""),
        ({"topics_to_filter": ["/latch"]}, "The bag has no topic '/latch'. Did you mean: /latched"),
        ({"exclude_topics_to_filter": ["/x"]}, "no topic '/x'. Its topics are /a, /b, /latched"),
        ({"clock_trigger_topics": ["/x"]}, "no topic '/x'"),
        ({"topic_qos_profile_overrides": {"/x": QoSProfile(depth=1)}}, "no topic '/x'"),
        (
            {"services_to_filter": ["/x/_service_event"]},
            "The bag has no events of a service '/x'. It has none at all.",
        ),
        ({"regex_to_filter": "x"}, "Nothing is played: the options leave out all topics, which"),
        ({"start_offset": 1000.0}, "Nothing is played: the bag ends after"),
        ({"playback_until_timestamp": 5}, "Nothing is played: the bag begins at 1800000000"),
        ({"playback_until_timestamp": 5, "playback_duration": 1.0}, ""),
    ],
)
def test_option_names_missing_from_the_bag(options, expected):
    with open_bag(SMALL) as bag:
        told = mistakes(bag, PlayOptions(**options))
    assert len(told) == bool(expected)
    assert expected in "".join(told)


def played(path, **options):
    """Play a bag to its end in this process."""
    player = rosbag2_py.Player()
    storage = StorageOptions(uri=str(path))
    player.play(storage, PlayOptions(disable_keyboard_controls=True, **options))


def test_clocks(peer, tmp_path):
    stamps = [START + i * SECOND for i in range(4)]
    with BagWriter(tmp_path / "bag") as writer:
        for name in ("/a", "/b"):
            writer.add_topic(name, "std_msgs/msg/String")
        writer.add_topic("/clock", "rosgraph_msgs/msg/Clock")
        for i, stamp in enumerate(stamps):
            writer.write("/clock", Clock(), stamp)
            writer.write(f"/{'ab'[i % 2]}", String(data=str(i)), stamp)
    heard = peer.listen("/clock", LOSSY, Clock)

    def times():
        return [each.clock.sec * SECOND + each.clock.nanosec for each in heard]

    played(tmp_path / "bag", rate=50.0, clock_publish_on_topic_publish=True)
    peer.wait_for(lambda: len(heard) >= 4)
    assert times() == stamps  # and nothing of the recorded clock
    heard.clear()
    played(tmp_path / "bag", rate=50.0, clock_trigger_topics=["/b"])
    peer.wait_for(lambda: len(heard) >= 2)
    assert times() == stamps[1::2]
    heard.clear()
    played(tmp_path / "bag", rate=3.0, clock_publish_frequency=100.0)
    peer.wait_for(lambda: len(heard) > 10)
    assert all(START <= time <= stamps[-1] + SECOND for time in times())
    heard.clear()
    played(tmp_path / "bag", rate=50.0)
    peer.wait_for(lambda: len(heard) == 4)
    assert times() == [0] * 4  # what was recorded


def events(path, count=4):
    """A bag with what a client (its requests are 1x) and a service (2x) told of calls."""
    event = get_message(EVENT)
    with BagWriter(path, chunk_bytes=20_000) as writer:
        writer.add_topic("/add/_service_event", EVENT)
        for i in range(count):
            for kind, first in ((0, 10 + i), (1, 20 + i)):
                message = event()
                message.info.event_type = kind
                message.request = [AddTwoInts.Request(a=first, b=1)]
                writer.write("/add/_service_event", message, START + i * SECOND // 10 + kind)
    return path


def test_damage_that_a_command_meets_ends_the_playback_with_one_line(bag_verb, tmp_path):
    path = events(tmp_path / "bag", count=3000)
    file = path / "bag_0.mcap"
    data = bytearray(file.read_bytes())
    data[len(data) // 2 : len(data) // 2 + 2000] = bytes(2000)
    file.write_bytes(data)
    program = bag_verb("burst", path)
    assert program.wait() == 1
    assert "Traceback" not in program.text
    assert program.text.count("bag_0.mcap: chunk at byte") == 1
    assert int(program.wait_for(r"Burst (\d+) messages")[0][1]) > 0


def test_malformed_events_are_told_and_not_sent(tmp_path, capfd):
    with BagWriter(tmp_path / "bag") as writer:
        writer.add_topic("/add/_service_event", EVENT)
        for data in (b"\0\1\0\0", b"\0\1\0\0\1\0\0"):
            writer.append("/add/_service_event", data, START, START)
    played(tmp_path / "bag", publish_service_requests=True)
    assert capfd.readouterr().err.count("A message was not played: ") == 1
    rosbag2_py.Info().read_metadata_and_output_service_verbose(str(tmp_path / "bag"))
    assert "Request Count: 1 | Response Count: 0" in capfd.readouterr().out


def test_a_file_that_is_missing_is_one_error(tmp_path):
    path = events(tmp_path / "bag")
    (path / "bag_0.mcap").unlink()
    with pytest.raises(RuntimeError, match=r"bag_0\.mcap: No such file or directory"):
        played(path)


def test_recorded_requests_skip_servers_that_misread_them(tmp_path, capfd, foreign_server):
    server = foreign_server("/add", "example_interfaces/srv/AddTwoInts")
    played(events(tmp_path / "bag"), rate=50.0, publish_service_requests=True)
    assert capfd.readouterr().err.count("no request is sent: service /add is not called: ") == 1
    assert server.take() == []


def test_recorded_requests_are_sent_again(peer, tmp_path, capfd):
    bag = events(tmp_path / "bag")
    played(bag, rate=50.0, publish_service_requests=True)
    assert capfd.readouterr().err.count("no request is sent: /add has no server") == 1
    got = []

    def add(request, response):
        with peer.changed:
            got.append(request.a)
            peer.changed.notify_all()
        return response

    peer.node.create_service(AddTwoInts, "/add", add)
    for source, expected in (
        (ServiceRequestsSource.SERVICE_INTROSPECTION, [20, 21, 22, 23]),
        (ServiceRequestsSource.CLIENT_INTROSPECTION, [10, 11, 12, 13]),
    ):
        got.clear()
        played(bag, publish_service_requests=True, service_requests_source=source)
        peer.wait_for(lambda: len(got) >= 4)
        assert got == expected


def test_offset_end_remapping_and_qos(peer, bag_verb, tmp_path):
    (tmp_path / "qos.yaml").write_text("/a: {reliability: best_effort, depth: 7}\n")
    moved, other = peer.listen("/moved", LOSSY), peer.listen("/b")
    player = bag_verb(
        *("play", SMALL, "--topics", "/a", "-m", "/a:=/moved", "-r", "20", "-d", "0.2", "-p"),
        *("--start-offset", "0.5", "--playback-until-nsec", str(START + 2 * SECOND)),
        *("--qos-profile-overrides-path", "qos.yaml", "--wait-for-all-acked", "60000"),
        *("--disable-keyboard-controls", "--log-level", "info"),
    )
    player.wait_for("Overriding QoS profile for topic /a")
    graph = peer.context.wire.graph
    assert graph.wait_for(lambda: offered(graph, "/moved"), 60_000_000_000)
    assert offered(graph, "/moved")[0].reliability == Reliability.BEST_EFFORT
    assert peer.call(srv.IsPaused, "/rosbag2_player/is_paused").paused
    assert not peer.call(srv.Play, "/rosbag2_player/play").success
    player.wait_for("Trying to play.* while in playback, dismissing request")
    peer.call(srv.Resume, "/rosbag2_player/resume")
    assert player.wait() == 0
    with open_bag(SMALL) as bag:
        expected = [
            message.decode().data
            for message in bag.messages(
                "/a", start_ns=bag.start_ns + SECOND // 2, end_ns=START + 2 * SECOND
            )
        ]
    assert 0 < len(expected) < len(texts(SMALL, "/a"))
    peer.wait_for(lambda: moved)
    arrived = [message.data for message in moved]
    # Best effort: on a busy machine some may be lost, but none is new or moved.
    assert arrived == [data for data in expected if data in arrived]
    assert other == []


def offered(graph, topic):
    return [
        each.qos for each in graph.endpoints() if (each.kind, each.topic) == ("publisher", topic)
    ]


def test_late_listeners_get_the_whole_tree(peer, bag_verb):
    player = bag_verb("play", SMALL, "-p", "--disable-keyboard-controls")
    seek, name = "/rosbag2_player/seek", "/tf_static"
    leaves = {f"leaf{i:02d}" for i in range(13)}
    for second in (3, 1, 2):
        peer.call(srv.Seek, seek, time=Time(nanoseconds=START + second * SECOND).to_msg())
        late = peer.listen(name, LATCHED, TFMessage)
        peer.wait_for(lambda: {frame for m in late for frame in frames(m)} == leaves)  # noqa: B023
    peer.call(srv.Stop, "/rosbag2_player/stop")
    assert player.wait() == 0


def frames(message):
    return [transform.child_frame_id for transform in message.transforms]


def test_a_listener_that_stands_still_does_not_hold_back_ctrl_c(peer, bag_verb, run):
    got = peer.listen("/a")
    program = run(ROS2, "topic", "echo", "/a", "std_msgs/msg/String")
    graph = peer.context.wire.graph
    assert graph.wait_for(lambda: listeners(graph, "/a") == 2, 60_000_000_000)
    options = ("-r", "50", "--disable-keyboard-controls", "--topics", "/a")
    player = bag_verb("play", SMALL, *options, "--wait-for-all-acked", "0", "-p")
    assert peer.call(srv.IsPaused, "/rosbag2_player/is_paused").paused
    program.signal_group(signal.SIGSTOP)
    peer.call(srv.Resume, "/rosbag2_player/resume")
    peer.wait_for(lambda: len(got) == len(texts(SMALL, "/a")))
    assert end(player) == 0
    assert "Traceback" not in player.text


def listeners(graph, topic):
    return sum((each.kind, each.topic) == ("subscription", topic) for each in graph.endpoints())
