"""The QoS with which a player publishes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.wire.qos import Durability, History, Liveliness, QoS, Reliability

if TYPE_CHECKING:
    from turtlewire.bag import TopicInfo

__all__ = ["publisher_qos"]

_DEFAULT_DEPTH = 10
_DIFFERENT = (
    "Not all original publishers on topic {topic} offered the same QoS profiles. Rosbag2 cannot "
    "yet choose an adapted profile to offer for this mixed case. "
    "Falling back to the rosbag2_transport default publisher offer."
)
_CHOSEN = (Reliability.RELIABLE, Reliability.BEST_EFFORT)


def publisher_qos(topic: TopicInfo) -> tuple[QoS, str | None]:
    """Return the QoS that the publishers of a recorded topic offered.

    A latched topic is as deep as it needs to be for one that joins late to get what all recorded
    publishers kept; rosbag2 gives the last ten messages, and loses parts of larger static trees.
    It is not deeper: what each round of a loop repeats would pile up.

    Returns:
        The QoS, and a warning if the recorded publishers differed.
    """
    offered = topic.qos
    if not offered:
        return QoS(), None
    alike = {(qos.reliability, qos.durability, qos.deadline_ns, qos.liveliness) for qos in offered}
    if len(alike) > 1:
        return QoS(), _DIFFERENT.format(topic=topic.name)
    first = offered[0]
    qos = QoS(
        reliability=first.reliability if first.reliability in _CHOSEN else Reliability.RELIABLE,
        deadline_ns=first.deadline_ns,
        liveliness=(
            Liveliness.SYSTEM_DEFAULT
            if first.liveliness == Liveliness.UNKNOWN
            else first.liveliness
        ),
        liveliness_lease_ns=first.liveliness_lease_ns,
    )
    if first.durability == Durability.TRANSIENT_LOCAL:
        qos = qos._replace(durability=first.durability, depth=_latched_depth(topic))
    return qos, None


def _latched_depth(topic: TopicInfo) -> int:
    """Return the number of latched messages for listeners that join late."""
    depths = [qos.depth if qos.history == History.KEEP_LAST else 0 for qos in topic.qos]
    kept = sum(depths) if all(depths) else topic.message_count
    if topic.type == "tf2_msgs/msg/TFMessage":  # each message may bring other frames
        kept = topic.message_count
    return min(max(_DEFAULT_DEPTH, kept), topic.message_count) or _DEFAULT_DEPTH
