"""The reasons why a middleware does not connect a publisher and a subscription of one topic.

A pair connects if the publisher offers at least what the subscription requests. Both must also use
the same type.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from .environment import compares_qos
from .qos import INFINITE_NS, Durability, Liveliness, Reliability

if TYPE_CHECKING:
    from .base import EndpointInfo
    from .qos import QoS

__all__ = ["Obstacle", "obstacles"]


class Obstacle(NamedTuple):
    """A reason why two endpoints are not connected.

    Attributes:
        policy: The QoS policy, for example ``reliability``, or ``type``.
        reason: The reason in words; "it" is the subscription.
    """

    policy: str
    reason: str


def obstacles(publisher: EndpointInfo, subscription: EndpointInfo) -> list[Obstacle]:
    """Return all reasons why the middleware does not connect two endpoints; empty if it does."""
    found = _obstacles_of_qos(publisher.qos, subscription.qos) if compares_qos() else []
    if publisher.type_name != subscription.type_name:
        text = f"its type is {subscription.type_name}, but the publisher's {publisher.type_name}"
        found.append(Obstacle("type", text))
    elif len({publisher.type_hash, subscription.type_hash} - {""}) > 1:
        found.append(Obstacle("type", "their definitions of the type differ"))
    return found


def _obstacles_of_qos(offered: QoS, requested: QoS) -> list[Obstacle]:
    found = []
    if (offered.reliability, requested.reliability) == (
        Reliability.BEST_EFFORT,
        Reliability.RELIABLE,
    ):
        found.append(_words("reliability", "RELIABLE", "BEST_EFFORT"))
    if (offered.durability, requested.durability) == (
        Durability.VOLATILE,
        Durability.TRANSIENT_LOCAL,
    ):
        found.append(_words("durability", "TRANSIENT_LOCAL", "VOLATILE"))
    if _limit(requested.deadline_ns) < _limit(offered.deadline_ns):
        words = map(_seconds, (requested.deadline_ns, offered.deadline_ns))
        found.append(_words("deadline", *(f"a deadline {word}" for word in words)))
    if (
        requested.liveliness == Liveliness.MANUAL_BY_TOPIC
        and offered.liveliness != Liveliness.MANUAL_BY_TOPIC
    ):
        found.append(_words("liveliness", "MANUAL_BY_TOPIC", "AUTOMATIC"))
    if _limit(requested.liveliness_lease_ns) < _limit(offered.liveliness_lease_ns):
        words = map(_seconds, (requested.liveliness_lease_ns, offered.liveliness_lease_ns))
        found.append(_words("liveliness", *(f"a liveliness lease {word}" for word in words)))
    return found


def _words(policy: str, requested: str, offered: str) -> Obstacle:
    return Obstacle(policy, f"it requests {requested}, but the publisher offers {offered}")


def _limit(duration_ns: int) -> int:
    return duration_ns or INFINITE_NS


def _seconds(duration_ns: int) -> str:
    limit = _limit(duration_ns)
    return "without limit" if limit >= INFINITE_NS else f"of {limit / 1e9:g} s"
