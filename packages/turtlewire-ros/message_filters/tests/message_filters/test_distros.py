"""Differences between distributions, each in its own process."""

import pytest
from tests.programs import OUTCOME, lines_in

START = """
from message_filters import ApproximateTimeSynchronizer, Cache, SimpleFilter
from rclpy.time import Time
from std_msgs.msg import Header, String
from geometry_msgs.msg import PointStamped
"""


def said(distro, program):
    return lines_in(distro, OUTCOME + START + program)


@pytest.mark.parametrize(
    ("distro", "expected"),
    [
        ("jazzy", "7 []"),
        (
            "kilted",
            (
                "7 ['DeprecationWarning: Deprecated in favour of "
                ":py:classmethod:Cache.getLatestTime:.']"
            ),
        ),
        ("lyrical", "AttributeError: 'Cache' object has no attribute 'getLastestTime'"),
    ],
)
def test_the_misspelt_name_of_the_latest_time(distro, expected):
    program = """
cache = Cache()
cache.add(PointStamped(header=Header(stamp=Time(nanoseconds=7).to_msg())))
print(outcome(lambda: cache.getLatestTime().nanoseconds))
print(outcome(lambda: cache.getLastestTime().nanoseconds))
"""
    assert said(distro, program) == ["7 []", expected]


SYNCHRONIZED = """
def sets(*arguments, **options):
    left, right, heard = SimpleFilter(), SimpleFilter(), []
    both = ApproximateTimeSynchronizer([left, right], 5, 1e-7, *arguments, **options)
    both.registerCallback(lambda *messages: heard.append(len(messages)))
    for source, stamp_ns in ((left, 1000), (right, 6000)):
        source.signalMessage(PointStamped(header=Header(stamp=Time(nanoseconds=stamp_ns).to_msg())))
    return heard, both.allow_headerless, both.queue_offset, both.sync_arrival_time
"""

REFUSED_OFFSETS = (
    "TypeError: allow_headerless is True or False, not [0, 5000]. In Jazzy it is the fourth "
    "argument: write queue_offset=[0, 5000]"
)
REFUSED_TRUE = (
    "TypeError: queue_offset is a list of nanoseconds, one for each filter, not True. From Kilted "
    "on it is the fourth argument: write allow_headerless=True"
)


@pytest.mark.parametrize(
    ("distro", "of_true", "of_offsets"),
    [
        ("jazzy", "([], True, [0, 0], False) []", REFUSED_OFFSETS),
        *[
            (distro, REFUSED_TRUE, "([2], False, [0, 5000], False) []")
            for distro in ("kilted", "lyrical")
        ],
    ],
)
def test_the_fourth_argument_of_a_synchronizer(distro, of_true, of_offsets):
    program = """
print(outcome(lambda: sets(True)))
print(outcome(lambda: sets([0, 5000])))
print(outcome(lambda: sets(*FOURTH_AND_FIFTH)))
print(outcome(lambda: sets(allow_headerless=True, queue_offset=[0, 5000])))
print(outcome(lambda: sets(False, False, True)))
"""
    fourth = "(True, [0, 5000])" if distro == "jazzy" else "([0, 5000], True)"
    told = said(distro, SYNCHRONIZED + program.replace("FOURTH_AND_FIFTH", fourth))
    both = "([2], True, [0, 5000], False) []"
    assert told[:4] == [of_true, of_offsets, both, both]
    assert told[4].endswith("False, [0, 0], True) []")
