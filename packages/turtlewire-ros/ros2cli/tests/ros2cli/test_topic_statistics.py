"""`ros2 topic hz`, `bw` and `delay`: the texts of ROS 2, of one topic and of several."""

import sys
import threading
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.needs import needs_cyclone_dds
from tests.programs import ROS2, ROS2_IN_SHELL, offered

from rclpy.time import Time
from ros2cli.main import main
from ros2interface.verb.show import InterfaceTextLine
from ros2topic.verb.bw import ROSTopicBandwidth
from ros2topic.verb.delay import ROSTopicDelay
from ros2topic.verb.hz import ROSTopicHz
from std_msgs.msg import Header
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


class Node:
    """A node whose clock shows what the test sets."""

    def __init__(self):
        self.now_ns = 0

    def get_clock(self):
        return self

    def now(self):
        return Time(nanoseconds=self.now_ns)


class Stamped:
    """A message with a header."""

    def __init__(self, stamp_s):
        self.header = Header(stamp=Time(seconds=stamp_s).to_msg())


def rates(window, times_ns):
    """Return the rates of messages that came at these times."""
    node = Node()
    hz = ROSTopicHz(node, window)
    for node.now_ns in times_ns:
        hz.callback_hz(None)
    return hz


def test_the_rate_of_even_messages(capsys):
    hz = rates(10, range(0, 80_000_000, 20_000_000))
    hz.print_hz()
    text = "average rate: 50.000\n\tmin: 0.020s max: 0.020s std dev: 0.00000s window: 4\n"
    assert capsys.readouterr().out == text
    hz.print_hz()
    assert capsys.readouterr().out == ""


def test_one_message_has_no_rate(capsys):
    hz = rates(10, [5])
    hz.print_hz()
    assert hz.get_hz() is None
    assert capsys.readouterr().out == ""


def test_time_that_begins_anew_empties_the_window(capsys):
    second = 1_000_000_000
    rates(10, [0, second, 0]).print_hz()
    assert capsys.readouterr().out == "", "no interval counts"
    rates(10, [0, second, 0, second // 2]).print_hz()
    assert capsys.readouterr().out.startswith("average rate: 2.000\n")


def test_messages_of_one_moment_do_not_begin_anew():
    hz = rates(10, [5, 5])
    assert hz.get_times() == [0]
    assert hz.get_hz() == (0.0, 0, 0, 0.0, 1), "no time has passed, so there is no rate"
    assert rates(10, [5, 5, 9, 9]).get_times() == [0, 4, 0]
    assert rates(10, [5, 4]).get_times() == []


@given(st.lists(st.integers(1, 10**12), min_size=2, max_size=50), st.integers(1, 20))
def test_a_window_never_holds_more_than_was_asked_for(steps, window):
    times, now = [], 0
    for step in steps:
        now += step
        times.append(now)
    held = rates(window, times).get_hz()[-1] + 1
    assert held == min(max(window, 2), len(steps)), "an interval has two messages"


def test_only_messages_that_the_filter_keeps_count():
    node = Node()
    hz = ROSTopicHz(node, 10, lambda message: message > 0)
    for node.now_ns, message in ((1, 1), (2, -1), (3, 1)):
        hz.callback_hz(message)
    assert hz.get_times() == [2]


def test_corrections_of_the_wall_clock_are_no_intervals(monkeypatch):
    steady = iter((0, 0, 10))
    monkeypatch.setattr(time, "monotonic_ns", lambda: next(steady))
    hz = ROSTopicHz(Node(), 10, use_wtime=True)
    hz.callback_hz(None)
    monkeypatch.setattr(time, "time_ns", lambda: 0)
    hz.callback_hz(None)
    assert hz.get_times() == [10]


@pytest.mark.parametrize(
    ("size", "text"),
    [
        (24, "240 B/s from 5 messages\n\tMessage size mean: 24 B min: 24 B max: 24 B\n"),
        (99, "990 B/s from 5 messages\n\tMessage size mean: 99 B min: 99 B max: 99 B\n"),
        (
            100,
            "1.00 KB/s from 5 messages\n\tMessage size mean: 0.10 KB min: 0.10 KB max: 0.10 KB\n",
        ),
        (
            2400,
            "24.00 KB/s from 5 messages\n\tMessage size mean: 2.40 KB min: 2.40 KB max: 2.40 KB\n",
        ),
        (
            99_999,
            (
                "999.99 KB/s from 5 messages\n\tMessage size mean: 100.00 KB min: 100.00 KB "
                "max: 100.00 KB\n"
            ),
        ),
        (
            100_000,
            "1.00 MB/s from 5 messages\n\tMessage size mean: 0.10 MB min: 0.10 MB max: 0.10 MB\n",
        ),
        (
            240_000,
            "2.40 MB/s from 5 messages\n\tMessage size mean: 0.24 MB min: 0.24 MB max: 0.24 MB\n",
        ),
    ],
)
def test_units_of_the_bandwidth_follow_the_rate(monkeypatch, capsys, size, text):
    now = iter((0.0, 0.1, 0.2, 0.3, 0.4, 0.5))
    monkeypatch.setattr(time, "monotonic", lambda: next(now))
    bandwidth = ROSTopicBandwidth(Node(), 100)
    for _ in range(5):
        bandwidth.callback(bytes(size))
    bandwidth.print_bw()
    assert capsys.readouterr().out == text


def test_the_table_leaves_out_topics_that_were_silent_since_the_last_one(monkeypatch, capsys):
    now = iter(range(100))
    monkeypatch.setattr(time, "monotonic", lambda: next(now))
    bandwidth = ROSTopicBandwidth(Node(), 100)

    def shown(*heard):
        for topic in heard * 2:
            bandwidth.callback(b"x", topic=topic)
        bandwidth.print_bw(["/a", "/b"])
        return [line.split()[0] for line in capsys.readouterr().out.splitlines()[2:] if line]

    assert shown("/a", "/b") == ["/a", "/b"]
    assert shown("/b") == ["/b"]
    assert shown() == []
    assert shown("/a") == ["/a"]
    assert shown("/a", "/b") == ["/a", "/b"]


def test_one_message_has_no_bandwidth(capsys):
    bandwidth = ROSTopicBandwidth(Node(), 100)
    bandwidth.callback(b"x")
    bandwidth.print_bw()
    assert capsys.readouterr().out == ""
    bandwidth.callback(b"x")
    bandwidth.print_bw()
    assert "/s from 2 messages\n" in capsys.readouterr().out


def test_delays(capsys):
    node = Node()
    delay = ROSTopicDelay(node, 3)
    for stamp_s, wait_ns in ((1, 9_000_000_000), (2, 100_000_000), (3, 200_000_000)):
        node.now_ns = stamp_s * 1_000_000_000 + wait_ns
        delay.callback_delay(Stamped(stamp_s))
    node.now_ns = 4_300_000_000
    delay.callback_delay(Stamped(4))
    delay.print_delay()
    text = "average delay: 0.200\n\tmin: 0.100s max: 0.300s std dev: 0.08165s window: 3\n"
    assert capsys.readouterr().out == text
    delay.print_delay()
    assert capsys.readouterr().out == ""


def test_bandwidths_count_the_newest_messages_of_each_topic():
    bandwidth = ROSTopicBandwidth(None, 2)
    for size in (1, 2, 3):
        bandwidth.callback(bytes(size), "/a")
    bandwidth.callback(b"x", "/b")
    assert (bandwidth.get_sizes("/a"), bandwidth.get_sizes("/b")) == ([2, 3], [1])
    assert len(bandwidth.get_times("/a")) == 2
    assert bandwidth.get_last_printed_tn("/a") == 0.0
    bandwidth.set_times([0.0, 1.0], "/a")
    bandwidth.set_sizes([4, 6], "/a")
    bandwidth.set_last_printed_tn(1.0, "/a")
    assert bandwidth.get_bw("/a")[1:] == (2, 5, 4, 6)
    assert bandwidth.get_last_printed_tn("/a") == 1.0


def test_lines_of_definitions():
    line = InterfaceTextLine("turtlesim", "msg/Path", "Pose[] poses  # where it was")
    assert line.nested_type == "turtlesim/msg/Pose"
    assert (line.is_comment(), line.is_trailing_comment()) == (False, True)
    assert line.trailing_comment == "# where it was"
    assert str(line) == "Pose[] poses  # where it was"
    comment = InterfaceTextLine("p", "msg/M", "  # alone")
    assert (comment.is_comment(), comment.is_trailing_comment()) == (True, False)
    assert comment.trailing_comment is None
    header = InterfaceTextLine("p", "msg/M", "Header header")
    assert (header.nested_type, header.trailing_comment) == ("std_msgs/msg/Header", None)
    for text in ("int32 MAX=3", "---", "", "string text '# no comment'"):
        assert InterfaceTextLine("p", "msg/M", text).nested_type is None


# `ros2 topic hz` and `bw` of several topics.

CLEAR = "\x1b[H\x1b[2J"


@pytest.fixture
def talkers():
    """Publish texts on /chat and /chatter, and register /strange, whose type is unknown."""
    context, end = open_context(), threading.Event()
    node = context.create_node("talker")
    kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
    publishers = [node.create_publisher(topic, kind, QoS()) for topic in ("/chat", "/chatter")]
    node.create_publisher("/strange", TypeId("no_msgs/msg/Such", "RIHS01_" + "0" * 64), QoS())
    message = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello"))

    def talk():
        while not end.wait(0.02):
            for publisher in publishers:
                publisher.publish(message)

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    end.set()
    thread.join()
    context.close()


def test_the_table_of_rates(capsys):
    clock = Node()
    hz = ROSTopicHz(clock, 10)
    for clock.now_ns in range(0, 900_000_000, 100_000_000):
        hz.callback_hz(None, "/chat")
        hz.callback_hz(None, "/tf")
    hz.callback_hz(None, "/once")
    hz.print_hz(["/chat", "/tf", "/once", "/silent"])
    table = (
        "topic    rate    min_delta   max_delta   std_dev   window",
        "=" * 57,
        "/chat   10.000   0.100       0.100       0.00000   9     ",
        "/tf     10.000   0.100       0.100       0.00000   9     ",
    )
    assert capsys.readouterr().out == "\n".join(table) + "\n\n"
    clock.now_ns = 900_000_000
    hz.callback_hz(None, "/tf")
    hz.print_hz(["/chat", "/tf"], clear_screen=True)
    lines = capsys.readouterr().out.splitlines()
    assert (lines[0][: len(CLEAR)], len(lines)) == (CLEAR, 4)
    assert lines[2].startswith("/tf  ")
    hz.print_hz(["/chat", "/tf"], clear_screen=True)
    assert capsys.readouterr().out == ""


def test_the_table_of_bandwidths(monkeypatch, capsys):
    now = iter((0.0, 0.5, 0.0, 0.5, 1.0, 1.0, 1.5))
    monkeypatch.setattr("time.monotonic", lambda: next(now))
    bandwidth = ROSTopicBandwidth(Node(), 10)
    for topic, size in (("/chat", 86), ("/image", 50_000)):
        for _ in range(2):
            bandwidth.callback(bytes(size), topic)
    bandwidth.print_bw(["/chat", "/image", "/silent"])
    table = (
        "topic     bandwidth    window     mean       min        max   ",
        "=" * 62,
        "/chat    172 B/s       2        86 B       86 B       86 B    ",
        "/image   100.00 KB/s   2        50.00 KB   50.00 KB   50.00 KB",
    )
    assert capsys.readouterr().out == "\n".join(table) + "\n\n"
    bandwidth.print_bw(["/chat", "/image"])
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("verb", "row"),
    [
        ("hz", r"^/chat(ter)? +\d+\.\d{3}   \d\.\d{3} +\d\.\d{3} +\d\.\d{5}   \d+ *$"),
        ("bw", r"^/chat(ter)? +[\d.]+ K?B/s +\d+ +(1[46] B) +\2 +\2 *$"),
    ],
)
def test_two_topics(run, talkers, verb, row):
    # A topic that does not exist yet does not hold up the others.
    shown = run(*ROS2, "topic", verb, "/later", "/chat", "chatter")
    topics = {match.group(1) for match in shown.wait_for(row, count=4)}
    assert topics == {None, "ter"}
    assert "WARNING: topic [/later] does not appear to be published yet" in shown.text
    assert "\x1b" not in shown.text


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_all_topics(run, talkers, verb):
    shown = run(*ROS2, "topic", verb, "--all")
    shown.wait_for("^/chatter ", count=2)
    first, *_ = lines = shown.text.splitlines()
    assert first == "Subscribing to all 5 available topics..."
    assert "WARNING: failed to find message type for topic [/strange]" in lines
    assert any(line.startswith(f"{CLEAR}") and "window" in line for line in lines)


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_a_reader_of_a_table_that_ends_early_is_no_error(run, talkers, verb):
    command = f"{ROS2_IN_SHELL} topic {verb} /chat /chatter | grep -m 1 window"
    reader = run("bash", "-c", command)
    assert reader.wait() == 0
    (columns,) = reader.text.splitlines()
    assert columns.split()[0] == "topic"


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_wrong_choices_of_topics(capsys, verb):
    assert main(["topic", verb, "-a", "/chat"]) == 1
    assert capsys.readouterr() == ("", "Cannot specify both --all/-a and topic names\n")
    with pytest.raises(SystemExit) as end:
        main(["topic", verb])
    assert end.value.code == 2
    missing = f"ros2 topic {verb}: error: the following arguments are required: topic_name\n"
    assert capsys.readouterr().err.endswith(missing)


def test_completion_of_a_second_topic(talkers):
    assert {"/chat", "/chatter"} <= set().union(
        *(offered("ros2 topic hz /strange /ch") for _ in range(3))
    )


STAMPED = """
import rclpy
from geometry_msgs.msg import PointStamped
rclpy.init()
node = rclpy.create_node("volatile")
publisher = node.create_publisher(PointStamped, "/point", 1)
print("ready", flush=True)
rclpy.spin(node)
"""


@needs_cyclone_dds  # Zenoh connects endpoints of any QoS
@pytest.mark.parametrize("verb", ["bw", "delay"])
def test_qos_of_the_subscription(run, verb):
    run(sys.executable, "-c", STAMPED).wait_for("ready")
    options = ("--qos-durability", "transient_local")
    run(*ROS2, "topic", verb, "/point", *options).wait_for(
        "'/point', offering incompatible QoS.*DURABILITY"
    )
