"""The former home of what is in :mod:`rclpy.event_handler` now; importing it warns."""

from __future__ import annotations

import warnings

from .event_handler import (
    PublisherEventCallbacks,
    QoSDeadlineOfferedInfo,
    QoSDeadlineRequestedInfo,
    QoSEventHandler,
    QoSLivelinessChangedInfo,
    QoSLivelinessLostInfo,
    QoSMessageLostInfo,
    QoSOfferedIncompatibleQoSInfo,
    QoSPublisherEventType,
    QoSRequestedIncompatibleQoSInfo,
    QoSSubscriptionEventType,
    SubscriptionEventCallbacks,
    UnsupportedEventTypeError,
)

__all__ = [
    "PublisherEventCallbacks",
    "QoSDeadlineOfferedInfo",
    "QoSDeadlineRequestedInfo",
    "QoSEventHandler",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMessageLostInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]

warnings.warn(
    "importing from rclpy.qos_event is deprecated, import from rclpy.event_handler instead",
    DeprecationWarning,
    stacklevel=2,
)
