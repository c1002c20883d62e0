"""Compares offered and requested profiles, with ROS 2's reasons.

Used by :func:`rclpy.qos.qos_check_compatible`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import (
    DurabilityPolicy,
    LivelinessPolicy,
    QoSCompatibility,
    QoSPolicyEnum,
    QoSProfile,
    ReliabilityPolicy,
)
from turtlewire.wire.environment import compares_qos

if TYPE_CHECKING:
    from rclpy.duration import Duration

# Not set, and ROS 2's infinite duration.
_UNLIMITED_NS = (0, 2**63 - 1)


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
    warnings = _warnings(publisher, subscription)
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
    if _is_limited(subscription.deadline):
        if not _is_limited(publisher.deadline):
            found.append("Subscription has a deadline, but publisher does not")
        elif subscription.deadline < publisher.deadline:
            found.append("Subscription deadline is less than publisher deadline")
    if (
        publisher.liveliness == LivelinessPolicy.AUTOMATIC
        and subscription.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
    ):
        found.append("Publisher's liveliness is automatic and subscription's is manual by topic")
    if _is_limited(subscription.liveliness_lease_duration):
        if not _is_limited(publisher.liveliness_lease_duration):
            found.append("Subscription has a liveliness lease duration, but publisher does not")
        elif subscription.liveliness_lease_duration < publisher.liveliness_lease_duration:
            found.append("Subscription liveliness lease duration is less than publisher")
    return found


def _warnings(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    """Return a warning for each policy that the middleware will settle."""
    findings = [
        _open(
            (publisher.reliability, subscription.reliability),
            (ReliabilityPolicy.BEST_EFFORT, ReliabilityPolicy.RELIABLE),
            "Publisher reliability is {} and subscription reliability is {}",
            "Reliable subscription, but publisher is {}",
            "Best effort publisher, but subscription is {}",
        ),
        _open(
            (publisher.durability, subscription.durability),
            (DurabilityPolicy.VOLATILE, DurabilityPolicy.TRANSIENT_LOCAL),
            "Publisher durabilty is {} and subscription durability is {}",  # ROS 2's spelling
            "Transient local subscription, but publisher is {}",
            "Volatile publisher, but subscription is {}",
        ),
        _open(
            (publisher.liveliness, subscription.liveliness),
            (LivelinessPolicy.AUTOMATIC, LivelinessPolicy.MANUAL_BY_TOPIC),
            "Publisher liveliness is {} and subscription liveliness is {}",
            "Subscription's liveliness is manual by topic, but publisher's is {}",
            "Publisher's liveliness is automatic, but subscription's is {}",
        ),
    ]
    return [finding for finding in findings if finding]


def _open(
    ends: tuple[QoSPolicyEnum, QoSPolicyEnum],
    limits: tuple[QoSPolicyEnum, QoSPolicyEnum],
    both_open: str,
    open_offer: str,
    open_request: str,
) -> str:
    """Return the warning for one policy, or an empty string.

    Args:
        ends: What is offered and requested.
        limits: The weakest offer and the strictest request.
        both_open: The text if both ends leave the value open.
        open_offer: The text if the publisher does, and the request is the strictest.
        open_request: The text if the subscription does, and the offer is the weakest.
    """
    (offered, requested), (weakest, strictest) = ends, limits
    if _is_open(offered) and _is_open(requested):
        return both_open.format(offered.short_key, requested.short_key)
    if _is_open(offered) and requested == strictest:
        return open_offer.format(offered.short_key)
    if offered == weakest and _is_open(requested):
        return open_request.format(requested.short_key)
    return ""


def _is_limited(duration: Duration) -> bool:
    return duration.nanoseconds not in _UNLIMITED_NS


def _is_open(value: QoSPolicyEnum) -> bool:
    return value.name in {"SYSTEM_DEFAULT", "UNKNOWN"}
