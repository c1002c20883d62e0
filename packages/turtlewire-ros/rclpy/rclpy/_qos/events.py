"""The events of an endpoint's QoS, and the argument of the callback of each.

:mod:`rclpy.event_handler` has all of it under ROS 2's names.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from typing import Any, NamedTuple

from rclpy._rclpy_pybind11 import rmw_qos_policy_kind_t
from turtlewire.wire.base import EventKind, EventStatus


class QoSPublisherEventType(IntEnum):
    """The events of a publisher."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(IntEnum):
    """The events of a subscription."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class QoSDeadlineRequestedInfo(NamedTuple):
    """Messages did not come in time.

    Counted in all and since the last event, as in the other infos.
    """

    total_count: int
    total_count_change: int


class IncompatibleTypeInfo(NamedTuple):
    """Endpoints of the topic have another type."""

    total_count: int
    total_count_change: int


class QoSLivelinessLostInfo(NamedTuple):
    """The publisher did not say in time that it is alive."""

    total_count: int
    total_count_change: int


class QoSMessageLostInfo(NamedTuple):
    """Messages were lost."""

    total_count: int
    total_count_change: int


class QoSLivelinessChangedInfo(NamedTuple):
    """The number of matching publishers that are alive changed."""

    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int


class QoSRequestedIncompatibleQoSInfo(NamedTuple):
    """Publishers of the topic do not match because of their QoS."""

    total_count: int
    total_count_change: int
    last_policy_kind: rmw_qos_policy_kind_t


class QoSSubscriptionMatchedInfo(NamedTuple):
    """The number of matching publishers changed."""

    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int


class QoSDeadlineOfferedInfo(NamedTuple):
    """Messages were not sent in time."""

    total_count: int
    total_count_change: int


class QoSOfferedIncompatibleQoSInfo(NamedTuple):
    """Subscriptions of the topic do not match because of their QoS."""

    total_count: int
    total_count_change: int
    last_policy_kind: rmw_qos_policy_kind_t


class QoSPublisherMatchedInfo(NamedTuple):
    """The number of matching subscriptions changed."""

    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int


#: The names that ROS 2's own code gives them.
QoSOfferedDeadlineMissedInfo = QoSDeadlineOfferedInfo
QoSRequestedDeadlineMissedInfo = QoSDeadlineRequestedInfo


def _counts(info: Callable[..., Any]) -> Callable[[EventStatus], Any]:
    return lambda status: info(*status[:2])


def _policy(info: Callable[..., Any]) -> Callable[[EventStatus], Any]:
    return lambda status: info(*status[:2], rmw_qos_policy_kind_t(status.last_policy_kind))


def _matches(info: Callable[..., Any]) -> Callable[[EventStatus], Any]:
    return lambda status: info(*status[:4])


def _liveliness(status: EventStatus) -> QoSLivelinessChangedInfo:
    # All events share one status; in this one, the total counts the publishers that are not alive.
    return QoSLivelinessChangedInfo(
        status.current_count,
        status.total_count,
        status.current_count_change,
        status.total_count_change,
    )


#: The middleware's name of an event, and what makes its info.
Report = tuple[EventKind, "Callable[[EventStatus], Any]"]

_OF_PUBLISHERS: dict[QoSPublisherEventType, Report] = {
    QoSPublisherEventType.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED: (
        EventKind.DEADLINE_MISSED,
        _counts(QoSDeadlineOfferedInfo),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_LIVELINESS_LOST: (
        EventKind.LIVELINESS_LOST,
        _counts(QoSLivelinessLostInfo),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS: (
        EventKind.INCOMPATIBLE_QOS,
        _policy(QoSOfferedIncompatibleQoSInfo),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_INCOMPATIBLE_TYPE: (
        EventKind.INCOMPATIBLE_TYPE,
        _counts(IncompatibleTypeInfo),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_MATCHED: (
        EventKind.MATCHED,
        _matches(QoSPublisherMatchedInfo),
    ),
}
_OF_SUBSCRIPTIONS: dict[QoSSubscriptionEventType, Report] = {
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED: (
        EventKind.DEADLINE_MISSED,
        _counts(QoSDeadlineRequestedInfo),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_LIVELINESS_CHANGED: (
        EventKind.LIVELINESS_CHANGED,
        _liveliness,
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS: (
        EventKind.INCOMPATIBLE_QOS,
        _policy(QoSRequestedIncompatibleQoSInfo),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE: (
        EventKind.INCOMPATIBLE_TYPE,
        _counts(IncompatibleTypeInfo),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST: (
        EventKind.MESSAGE_LOST,
        _counts(QoSMessageLostInfo),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED: (
        EventKind.MATCHED,
        _matches(QoSSubscriptionMatchedInfo),
    ),
}


def report(event_type: QoSPublisherEventType | QoSSubscriptionEventType) -> Report:
    """Return the middleware's name of an event, and what makes its info."""
    if isinstance(event_type, QoSPublisherEventType):
        return _OF_PUBLISHERS[event_type]
    return _OF_SUBSCRIPTIONS[event_type]
