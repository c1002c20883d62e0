"""QoS of recorder and player: it matches all publishers, and is deep enough."""

import pytest

from rosbag2_transport.player_outputs import publisher_qos
from rosbag2_transport.recorder_qos import misses, subscription_qos
from turtlewire.bag import TopicInfo
from turtlewire.wire.qos import Durability, QoS, Reliability

PLAIN = QoS()
LOSSY = QoS(reliability=Reliability.BEST_EFFORT)
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


@pytest.mark.parametrize(
    ("offered", "reliability", "durability", "warned_of"),
    [
        ([], Reliability.RELIABLE, Durability.VOLATILE, []),
        ([PLAIN], Reliability.RELIABLE, Durability.VOLATILE, []),
        ([LOSSY], Reliability.BEST_EFFORT, Durability.VOLATILE, []),
        ([LATCHED, LATCHED], Reliability.RELIABLE, Durability.TRANSIENT_LOCAL, []),
        ([PLAIN, LOSSY], Reliability.BEST_EFFORT, Durability.VOLATILE, ["RELIABILITY"]),
        ([PLAIN, LATCHED], Reliability.RELIABLE, Durability.VOLATILE, ["DURABILITY"]),
    ],
)
def test_a_subscription_fits_all_publishers(offered, reliability, durability, warned_of):
    qos, warnings = subscription_qos("/a", offered)
    assert (qos.reliability, qos.durability) == (reliability, durability)
    assert len(warnings) == len(warned_of)
    assert all(word in text for word, text in zip(warned_of, warnings, strict=True))


def test_the_warning_is_that_of_the_real_one():
    _, warnings = subscription_qos("/notes", [PLAIN, LATCHED])
    assert warnings == [
        (
            'Some, but not all, publishers on topic "/notes" are offering '
            "RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL. Falling back to "
            "RMW_QOS_POLICY_DURABILITY_VOLATILE as it will connect to all publishers. "
            "Previously-published latched messages will not be retrieved."
        )
    ]


def test_new_incompatible_publishers_are_reported():
    assert misses("/a", PLAIN, PLAIN) is None
    assert misses("/a", LOSSY, PLAIN) is None
    assert "RELIABILITY_BEST_EFFORT, but" in (misses("/a", PLAIN, LOSSY) or "")
    assert "DURABILITY_VOLATILE, but" in (misses("/a", LATCHED, PLAIN) or "")


@pytest.mark.parametrize(
    ("type_name", "profiles", "count", "depth"),
    [
        ("tf2_msgs/msg/TFMessage", [LATCHED], 250, 250),  # each may bring other frames
        ("nav_msgs/msg/OccupancyGrid", [LATCHED], 250, 10),
        ("nav_msgs/msg/OccupancyGrid", [LATCHED], 2, 2),  # rounds of a loop do not pile up
        ("nav_msgs/msg/OccupancyGrid", [LATCHED] * 30, 250, 30),
        ("std_msgs/msg/String", [PLAIN._replace(depth=500)], 250, 10),
    ],
)
def test_latched_topics_are_as_deep_as_late_listeners_need(type_name, profiles, count, depth):
    qos, warning = publisher_qos(TopicInfo("/a", type_name, qos=profiles, message_count=count))
    assert (qos.depth, warning) == (depth, None)
    assert qos.durability == profiles[0].durability


def test_publishers_that_differed_are_played_with_the_default():
    qos, warning = publisher_qos(TopicInfo("/a", "std_msgs/msg/String", qos=[PLAIN, LOSSY]))
    assert qos == QoS()
    assert "Not all original publishers on topic /a offered the same QoS" in (warning or "")
