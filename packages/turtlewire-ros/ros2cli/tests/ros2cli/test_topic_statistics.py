"""Rates, sizes and delays, with the texts of ROS 2."""

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rclpy.time import Time
from ros2interface.verb.show import InterfaceTextLine
from ros2topic.verb.bw import ROSTopicBandwidth
from ros2topic.verb.delay import ROSTopicDelay
from ros2topic.verb.hz import ROSTopicHz
from std_msgs.msg import Header


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
