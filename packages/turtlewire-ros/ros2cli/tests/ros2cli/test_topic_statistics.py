"""Rates, sizes and delays, with the texts of ROS 2."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from ros2topic.statistics import Delays, Intervals, Sizes


def test_the_rate_of_even_messages():
    intervals = Intervals(10)
    for index in range(4):
        intervals.add(index * 20_000_000)
    assert (
        intervals.report()
        == "average rate: 50.000\n\tmin: 0.020s max: 0.020s std dev: 0.00000s window: 4\n"
    )
    assert intervals.report() == ""


def test_one_message_has_no_rate():
    intervals = Intervals(10)
    intervals.add(5)
    assert intervals.report() == ""


def test_time_that_begins_anew_empties_the_window():
    intervals = Intervals(10)
    for now in (0, 1_000_000_000, 0, 500_000_000):
        intervals.add(now)
    assert intervals.report().startswith("average rate: 2.000\n")


@given(st.lists(st.integers(0, 10**12), min_size=2, max_size=50), st.integers(2, 20))
def test_a_window_never_holds_more_than_was_asked_for(steps, window):
    intervals, now = Intervals(window), 0
    for step in steps:
        now += step
        intervals.add(now)
    held = int(intervals.report().rsplit("window: ", 1)[1])
    assert held == min(window, len(steps))


def test_units_of_the_bandwidth_follow_the_rate():
    for size, expected in (
        (24, "240 B/s from 5 messages\n\tMessage size mean: 24 B min: 24 B max: 24 B\n"),
        (
            2400,
            "24.00 KB/s from 5 messages\n\tMessage size mean: 2.40 KB min: 2.40 KB max: 2.40 KB\n",
        ),
    ):
        sizes = Sizes(100)
        for index in range(5):
            sizes.add(index * 0.1, size)
        assert sizes.report(0.5) == expected


def test_one_message_has_no_bandwidth():
    sizes = Sizes(100)
    sizes.add(0.0, 1)
    assert sizes.report(1.0) == ""


def test_delays():
    delays = Delays(3)
    for delay in (9.0, 0.1, 0.2, 0.3):
        delays.add(delay)
    assert (
        delays.report()
        == "average delay: 0.200\n\tmin: 0.100s max: 0.300s std dev: 0.08165s window: 3\n"
    )
    assert delays.report() == ""
