"""Events of an endpoint's QoS.

What a program can be told of, and ROS 2's default warnings about endpoints that do not match.
"""

from __future__ import annotations

from contextlib import suppress
from enum import IntEnum
from types import CoroutineType
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import WireError
from turtlewire.wire.base import EventKind, EventStatus

from ._execution.entity import Entity, Host
from ._rclpy_pybind11 import UnsupportedEventTypeError, rmw_qos_policy_kind_t
from .qos import qos_policy_name_from_kind
from .waitable import NumberOfEntities, Waitable, WaitSet

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.wire import base

    from .callback_groups import CallbackGroup
    from .impl.rcutils_logger import RcutilsLogger

__all__ = [
    "EventHandler",
    "IncompatibleTypeInfo",
    "PublisherEventCallbacks",
    "QoSDeadlineOfferedInfo",
    "QoSDeadlineRequestedInfo",
    "QoSEventHandler",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMessageLostInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSPublisherMatchedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]


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
    """Messages did not come in time, or were not sent in time.

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
    """Endpoints of the topic do not match because of their QoS."""

    total_count: int
    total_count_change: int
    last_policy_kind: rmw_qos_policy_kind_t


class QoSSubscriptionMatchedInfo(NamedTuple):
    """The number of matching endpoints changed."""

    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int


QoSDeadlineOfferedInfo = QoSDeadlineRequestedInfo
QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo
QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo

_INFOS: dict[EventKind, Callable[[EventStatus], Any]] = {
    EventKind.DEADLINE_MISSED: lambda status: QoSDeadlineRequestedInfo(*status[:2]),
    EventKind.LIVELINESS_LOST: lambda status: QoSLivelinessLostInfo(*status[:2]),
    EventKind.MESSAGE_LOST: lambda status: QoSMessageLostInfo(*status[:2]),
    EventKind.LIVELINESS_CHANGED: lambda status: QoSLivelinessChangedInfo(
        status.current_count,
        status.total_count,
        status.current_count_change,
        status.total_count_change,
    ),
    EventKind.INCOMPATIBLE_QOS: lambda status: QoSRequestedIncompatibleQoSInfo(
        *status[:2], rmw_qos_policy_kind_t(status.last_policy_kind)
    ),
    EventKind.MATCHED: lambda status: QoSSubscriptionMatchedInfo(*status[:4]),
}


class _Event(Entity):
    """An event of the middleware, as the part of a waitable."""

    def __init__(self, wire: base.Event) -> None:
        super().__init__(None)
        self._wire = wire

    def _attach(self, host: Host) -> None:
        host.wait.watch(self._wire, self)

    def _detach(self, host: Host) -> None:
        host.wait.unwatch(self._wire)

    def _take(self) -> None:
        """The handler takes it."""

    def _close(self) -> None:
        self._wire.close()


class EventHandler(Waitable):
    """Calls ``callback(info)`` on the executor when the event happened.

    Args:
        callback_group: Of the callback.
        callback: What to call.
        event_type: Which event.
        parent_impl: The middleware's side of the publisher or subscription.

    Raises:
        UnsupportedEventTypeError: The middleware cannot report it.
    """

    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[[Any], Any],
        event_type: EventKind,
        parent_impl: base.Publisher | base.Subscription,
    ) -> None:
        super().__init__(callback_group)
        self.callback = callback
        self.event_type = event_type
        try:
            self._event = parent_impl.create_event(event_type)
        except WireError as error:
            raise UnsupportedEventTypeError(str(error)) from error
        self._part = _Event(self._event)

    def get_num_entities(self) -> NumberOfEntities:
        """One event."""
        return NumberOfEntities(num_events=1)

    def add_to_wait_set(self, wait_set: WaitSet) -> None:
        """Wait for the event."""
        self._index = wait_set.add_event(self._part)

    def is_ready(self, wait_set: WaitSet) -> bool:
        """Whether the event has happened."""
        return wait_set.is_ready("event", self._index)

    def take_data(self) -> Any:
        """What is known of the event; None if there was none after all."""
        status = self._event.take()
        return None if status is None else _INFOS[self.event_type](status)

    async def execute(self, taken_data: Any) -> None:
        """Call the callback."""
        if taken_data is None:
            return
        outcome = self.callback(taken_data)
        if isinstance(outcome, CoroutineType):
            await outcome

    def _close(self) -> None:
        self._part.destroy()
        super()._close()


class QoSEventHandler(EventHandler):
    """The former name of :class:`EventHandler`, of which making one warns."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        import warnings

        warnings.warn(
            "QoSEventHandler is deprecated, use EventHandler instead",
            DeprecationWarning,
            stacklevel=2,
        )
        super().__init__(*args, **kwargs)


class _EventCallbacks:
    """What publishers and subscriptions have in common."""

    #: How ROS 2 warns of an endpoint that does not match.
    _WARNING = ""

    incompatible_qos: Callable[[Any], None] | None
    incompatible_type: Callable[[IncompatibleTypeInfo], None] | None
    use_default_callbacks: bool

    def _wanted(self) -> dict[EventKind, Callable[[Any], None] | None]:
        raise NotImplementedError

    def create_event_handlers(
        self,
        callback_group: CallbackGroup,
        endpoint: base.Publisher | base.Subscription,
        topic_name: str,
        logger: RcutilsLogger,
    ) -> list[EventHandler]:
        """Make a handler for each callback; called by the node when it creates the endpoint.

        Raises:
            UnsupportedEventTypeError: The middleware cannot report one of the events.
        """
        if self.incompatible_type is not None:
            raise UnsupportedEventTypeError(
                "the middleware does not report endpoints of another type"
            )

        def handler(kind: EventKind, callback: Callable[[Any], None]) -> EventHandler:
            return EventHandler(
                callback_group=callback_group,
                callback=callback,
                event_type=kind,
                parent_impl=endpoint,
            )

        handlers = [
            handler(kind, callback)
            for kind, callback in self._wanted().items()
            if callback is not None
        ]
        if self.incompatible_qos is None and self.use_default_callbacks:
            # Zenoh has no such event, because everything matches.
            with suppress(UnsupportedEventTypeError):
                warn = self._warn_of_incompatible_qos(topic_name, logger)
                handlers.append(handler(EventKind.INCOMPATIBLE_QOS, warn))
        return handlers

    def _warn_of_incompatible_qos(
        self, topic_name: str, logger: RcutilsLogger
    ) -> Callable[[QoSRequestedIncompatibleQoSInfo], None]:
        text = self._WARNING

        def warn(event: QoSRequestedIncompatibleQoSInfo) -> None:
            logger.warning(
                text.format(topic_name, qos_policy_name_from_kind(event.last_policy_kind))
            )

        return warn


class SubscriptionEventCallbacks(_EventCallbacks):
    """What is to be called at the events of a subscription.

    Each callback gets the info of its event.

    Args:
        deadline: No message came in time (:class:`QoSDeadlineRequestedInfo`).
        incompatible_qos: A publisher does not match (:class:`QoSRequestedIncompatibleQoSInfo`).
        liveliness: A publisher came, went, or fell silent (:class:`QoSLivelinessChangedInfo`).
        message_lost: :class:`QoSMessageLostInfo`.
        incompatible_type: A publisher has another type; no middleware here reports it.
        matched: A matching publisher came or went (:class:`QoSSubscriptionMatchedInfo`).
        use_default_callbacks: Whether ROS 2's warning is logged when ``incompatible_qos`` is None.
    """

    _WARNING = (
        "New publisher discovered on topic '{}', offering incompatible QoS. No messages will be "
        "received from it. "
        "Last incompatible policy: {}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[QoSDeadlineRequestedInfo], None] | None = None,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], None] | None = None,
        liveliness: Callable[[QoSLivelinessChangedInfo], None] | None = None,
        message_lost: Callable[[QoSMessageLostInfo], None] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], None] | None = None,
        matched: Callable[[QoSSubscriptionMatchedInfo], None] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.message_lost = message_lost
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks

    def _wanted(self) -> dict[EventKind, Callable[[Any], None] | None]:
        return {
            EventKind.DEADLINE_MISSED: self.deadline,
            EventKind.INCOMPATIBLE_QOS: self.incompatible_qos,
            EventKind.LIVELINESS_CHANGED: self.liveliness,
            EventKind.MESSAGE_LOST: self.message_lost,
            EventKind.MATCHED: self.matched,
        }


class PublisherEventCallbacks(_EventCallbacks):
    """What is to be called at the events of a publisher; each callback gets the info of its event.

    Args:
        deadline: No message was sent in time (:class:`QoSDeadlineOfferedInfo`).
        incompatible_qos: A subscription does not match (:class:`QoSOfferedIncompatibleQoSInfo`).
        liveliness: It did not say in time that it is alive (:class:`QoSLivelinessLostInfo`).
        incompatible_type: A subscription has another type; no middleware here reports it.
        matched: A matching subscription came or went (:class:`QoSPublisherMatchedInfo`).
        use_default_callbacks: Whether ROS 2's warning is logged when ``incompatible_qos`` is None.
    """

    _WARNING = (
        "New subscription discovered on topic '{}', requesting incompatible QoS. No messages will "
        "be sent to it. "
        "Last incompatible policy: {}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[QoSDeadlineOfferedInfo], None] | None = None,
        incompatible_qos: Callable[[QoSOfferedIncompatibleQoSInfo], None] | None = None,
        liveliness: Callable[[QoSLivelinessLostInfo], None] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], None] | None = None,
        matched: Callable[[QoSPublisherMatchedInfo], None] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks

    def _wanted(self) -> dict[EventKind, Callable[[Any], None] | None]:
        return {
            EventKind.DEADLINE_MISSED: self.deadline,
            EventKind.INCOMPATIBLE_QOS: self.incompatible_qos,
            EventKind.LIVELINESS_LOST: self.liveliness,
            EventKind.MATCHED: self.matched,
        }
