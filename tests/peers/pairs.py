"""72 pairs of a publisher and a subscription, of which ours and a real node have one end each.

`pairs.py ours` has the publishers of the first 36 and the subscriptions of the others, with our
Python; `pairs.py theirs` has the other ends, with the Python of scripts/peers. Each prints for each
pair what rclpy's rule says, and whether its end matched or which policy was incompatible.
"""

import functools
import itertools
import sys

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_check_compatible,
    qos_policy_name_from_kind,
)
from std_msgs.msg import String

TIMES = [Duration(seconds=30), Duration(seconds=60), Duration()]  # the last is without end


def every(**policies):
    """All pairs of profiles that have one of the values of each policy."""
    # not the system's default, which rclpy's rule leaves open
    common = {"depth": 10, "liveliness": LivelinessPolicy.AUTOMATIC}
    ends = [
        QoSProfile(**common | dict(zip(policies, values, strict=True)))
        for values in itertools.product(*policies.values())
    ]
    return list(itertools.product(ends, ends))


def profiles():
    """The QoS of the publisher and of the subscription of each pair of one direction."""
    livelinesses = [LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC]
    histories = [HistoryPolicy.KEEP_LAST, HistoryPolicy.KEEP_ALL]
    return [
        *every(
            reliability=[ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT],
            durability=[DurabilityPolicy.TRANSIENT_LOCAL, DurabilityPolicy.VOLATILE],
        ),
        *every(deadline=TIMES),
        *every(liveliness=livelinesses, liveliness_lease_duration=TIMES[:1]),
        *every(liveliness_lease_duration=TIMES[:2])[1:],  # the first is the one of `livelinesses`
        *every(history=histories),
    ]


def say(number, *words):
    print(number, *words, flush=True)


def is_first(status):
    return status.total_count == status.total_count_change


def matched(number, status):
    if is_first(status):
        say(number, "matched")


def incompatible(number, status):
    if is_first(status):
        say(number, "incompatible", qos_policy_name_from_kind(status.last_policy_kind))


rclpy.init()
(end,) = sys.argv[1:]
node, kept = rclpy.create_node(end), []
for number, (offered, requested) in enumerate(2 * profiles()):
    say(number, "rule", qos_check_compatible(offered, requested)[0].name)
    calls = {
        "matched": functools.partial(matched, number),
        "incompatible_qos": functools.partial(incompatible, number),
    }
    topic = f"pair_{number}"
    if (number < 36) == (end == "ours"):
        events = PublisherEventCallbacks(**calls)
        kept.append(node.create_publisher(String, topic, offered, event_callbacks=events))
    else:
        events = SubscriptionEventCallbacks(**calls)
        kept.append(
            node.create_subscription(String, topic, print, requested, event_callbacks=events)
        )
rclpy.spin(node)
