"""Compares offered and requested profiles, with ROS 2's reasons.

Used by :func:`rclpy.qos.qos_check_compatible`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSPolicyEnum,
    QoSProfile,
    ReliabilityPolicy,
)
from turtlewire.wire.environment import compares_qos


def check(publisher: QoSProfile, subscription: QoSProfile) -> tuple[QoSCompatibility, str]:
    """Compare all policies that can keep two ends apart with the middleware in use.

    Returns:
        The worst finding, and the reasons of that severity, each ended by a semicolon.
    """
    if not compares_qos():
        return _check_without_matching(publisher, subscription)
    errors = _errors(publisher, subscription)
    if errors:
        return QoSCompatibility.ERROR, "".join(f"ERROR: {text};" for text in errors)
    warnings = list(_warnings(publisher, subscription))
    if warnings:
        return QoSCompatibility.WARNING, "".join(f"WARNING: {text};" for text in warnings)
    return QoSCompatibility.OK, ""


def _check_without_matching(
    publisher: QoSProfile, subscription: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """With Zenoh all ends match; a subscription may only miss what was published before."""
    if (
        publisher.durability == DurabilityPolicy.TRANSIENT_LOCAL
        and subscription.durability == DurabilityPolicy.VOLATILE
    ):
        text = "Publisher durability is transient local, but subscription durability is volatile"
        return QoSCompatibility.WARNING, f"WARNING: {text};"
    return QoSCompatibility.OK, ""


def _errors(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    found = []
    if (
        publisher.reliability == ReliabilityPolicy.BEST_EFFORT
        and subscription.reliability == ReliabilityPolicy.RELIABLE
    ):
        found.append("Best effort publisher and reliable subscription")
    if (
        publisher.durability == DurabilityPolicy.VOLATILE
        and subscription.durability == DurabilityPolicy.TRANSIENT_LOCAL
    ):
        found.append("Volatile publisher and transient local subscription")
    if subscription.deadline.nanoseconds:  # as in ROS 2, "infinite" is a deadline, too
        if not publisher.deadline.nanoseconds:
            found.append("Subscription has a deadline, but publisher does not")
        elif subscription.deadline < publisher.deadline:
            found.append("Subscription deadline is less than publisher deadline")
    if (
        publisher.liveliness == LivelinessPolicy.AUTOMATIC
        and subscription.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
    ):
        found.append("Publisher's liveliness is automatic and subscription's is manual by topic")
    if subscription.liveliness_lease_duration.nanoseconds:
        if not publisher.liveliness_lease_duration.nanoseconds:
            found.append("Subscription has a liveliness lease duration, but publisher does not")
        elif subscription.liveliness_lease_duration < publisher.liveliness_lease_duration:
            found.append("Subscription liveliness lease duration is less than publisher")
    return found


class _Texts(NamedTuple):
    """ROS 2's texts of a policy that the middleware will settle, in its own spelling."""

    both_open: str
    offer_open: str
    request_open: str


_RELIABILITY = _Texts(
    "Publisher reliability is {} and subscription reliability is {}",
    "Reliable subscription, but publisher is {}",
    "Best effort publisher, but subscription is {}",
)
_DURABILITY = _Texts(
    "Publisher durabilty is {} and subscription durability is {}",
    "Transient local subscription, but publisher is {}",
    "Volatile publisher, but subscription is {}",
)
_LIVELINESS = _Texts(
    "Publisher liveliness is {} and subscription liveliness is {}",
    "Subscription's liveliness is manual by topic, but publisher's is {}",
    "Publisher's liveliness is automatic, but subscription's is {}",
)


def _warnings(publisher: QoSProfile, subscription: QoSProfile) -> Iterator[str]:
    yield from _open(
        _RELIABILITY,
        (publisher.reliability, ReliabilityPolicy.BEST_EFFORT),
        (subscription.reliability, ReliabilityPolicy.RELIABLE),
    )
    yield from _open(
        _DURABILITY,
        (publisher.durability, DurabilityPolicy.VOLATILE),
        (subscription.durability, DurabilityPolicy.TRANSIENT_LOCAL),
    )
    yield from _open(
        _LIVELINESS,
        (publisher.liveliness, LivelinessPolicy.AUTOMATIC),
        (subscription.liveliness, LivelinessPolicy.MANUAL_BY_TOPIC),
    )


def _open(
    texts: _Texts,
    offer: tuple[QoSPolicyEnum, QoSPolicyEnum],
    request: tuple[QoSPolicyEnum, QoSPolicyEnum],
) -> Iterator[str]:
    """Compare the offer, given with the weakest one, to the request, given with the strictest."""
    (offered, weakest), (requested, strictest) = offer, request
    if _is_open(offered) and _is_open(requested):
        yield texts.both_open.format(offered.short_key, requested.short_key)
    elif _is_open(offered) and requested == strictest:
        yield texts.offer_open.format(offered.short_key)
    elif offered == weakest and _is_open(requested):
        yield texts.request_open.format(requested.short_key)


def _is_open(value: QoSPolicyEnum) -> bool:
    return value.name in {"SYSTEM_DEFAULT", "UNKNOWN"}
