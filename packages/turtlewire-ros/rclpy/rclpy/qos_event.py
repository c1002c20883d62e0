"""The old name of :mod:`rclpy.event_handler`; importing it warns.

Lyrical no longer has it.
"""

import warnings

from turtlewire.distro import LYRICAL, since

if since(LYRICAL):
    raise ModuleNotFoundError(f"No module named '{__name__}'", name=__name__)

from .event_handler import (
    PublisherEventCallbacks,
    QoSDeadlineOfferedInfo,
    QoSDeadlineRequestedInfo,
    QoSEventHandler,
    QoSLivelinessChangedInfo,
    QoSLivelinessLostInfo,
    QoSMessageLostInfo,
    QoSOfferedDeadlineMissedInfo,
    QoSOfferedIncompatibleQoSInfo,
    QoSPublisherEventType,
    QoSRequestedDeadlineMissedInfo,
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
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]

warnings.warn(
    "importing 'qos_event' is deprecated; import 'event_handler' instead", UserWarning, stacklevel=2
)
