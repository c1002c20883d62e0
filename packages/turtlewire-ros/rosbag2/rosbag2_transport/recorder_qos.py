"""The QoS with which a recorder subscribes, so that all publishers of a topic match."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rclpy.qos import QoSCompatibility, QoSProfile, qos_check_compatible
from turtlewire.wire.qos import Durability, History, QoS, Reliability

#: How many messages of a topic may wait for the recorder. rosbag2 takes rmw's default of 10, which
#: loses messages of a fast topic when the computer is busy for a moment; peers do not see it.
_DEPTH = 10_000

_SOME = 'Some, but not all, publishers on topic "{topic}" are offering {strong}. Falling back to '
_UNRELIABLE = (
    "{weak} as it will connect to all publishers. "
    "Some messages from Reliable publishers could be dropped."
)
_VOLATILE = (
    "{weak} as it will connect to all publishers. "
    "Previously-published latched messages will not be retrieved."
)
_NEW = (
    "A new publisher for subscribed topic {topic} was found offering {weak}, but rosbag already "
    "subscribed requesting {strong}. Messages from this new publisher will not be recorded."
)
_RELIABLE = {
    "strong": "RMW_QOS_POLICY_RELIABILITY_RELIABLE",
    "weak": "RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT",
}
_LATCHED = {
    "strong": "RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL",
    "weak": "RMW_QOS_POLICY_DURABILITY_VOLATILE",
}


def subscription_qos(topic: str, offered: Sequence[QoS]) -> tuple[QoS, list[str]]:
    """Return the strongest QoS that fits all publishers.

    Args:
        topic: Name of the topic, for the warnings.
        offered: What its publishers offer.

    Returns:
        The QoS, and what is lost because the publishers differ.
    """
    reliable = [qos.reliability == Reliability.RELIABLE for qos in offered]
    latched = [qos.durability == Durability.TRANSIENT_LOCAL for qos in offered]
    warnings = []
    if any(reliable) and not all(reliable):
        warnings.append((_SOME + _UNRELIABLE).format(topic=topic, **_RELIABLE))
    if any(latched) and not all(latched):
        warnings.append((_SOME + _VOLATILE).format(topic=topic, **_LATCHED))
    fitting = QoS(
        history=History.KEEP_LAST,
        depth=_DEPTH,
        reliability=Reliability.RELIABLE if all(reliable) else Reliability.BEST_EFFORT,
        durability=(
            Durability.TRANSIENT_LOCAL if latched and all(latched) else Durability.VOLATILE
        ),
    )
    return fitting, warnings


def misses(topic: str, requested: QoS, offered: QoS) -> str | None:
    """Return why the messages of a new publisher are not received; None if they are."""
    if (
        requested.durability == Durability.TRANSIENT_LOCAL
        and offered.durability == Durability.VOLATILE
    ):
        return _NEW.format(topic=topic, **_LATCHED)
    if (
        requested.reliability == Reliability.RELIABLE
        and offered.reliability == Reliability.BEST_EFFORT
    ):
        return _NEW.format(topic=topic, **_RELIABLE)
    return None


def refusal(requested: QoSProfile, offered: Iterable[QoS]) -> str:
    """Return why a publisher does not send to a subscription; empty if all do."""
    for qos in offered:
        found = qos_check_compatible(QoSProfile.from_wire(qos), requested)
        if found.compatibility == QoSCompatibility.ERROR:
            return found.reason
    return ""
