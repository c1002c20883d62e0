"""Events of an endpoint's QoS.

The event types, and ROS 2's default warnings about endpoints that do not match.
"""

from __future__ import annotations

from collections.abc import Callable
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from turtlewire.distro import LYRICAL, since
from turtlewire.errors import WireError
from turtlewire.wire.base import EventKind

from ._execution.entity import Entity, EntityHost
from ._qos.events import (
    IncompatibleTypeInfo,
    QoSDeadlineOfferedInfo,
    QoSDeadlineRequestedInfo,
    QoSLivelinessChangedInfo,
    QoSLivelinessLostInfo,
    QoSMessageLostInfo,
    QoSOfferedDeadlineMissedInfo,
    QoSOfferedIncompatibleQoSInfo,
    QoSPublisherEventType,
    QoSPublisherMatchedInfo,
    QoSRequestedDeadlineMissedInfo,
    QoSRequestedIncompatibleQoSInfo,
    QoSSubscriptionEventType,
    QoSSubscriptionMatchedInfo,
    report,
)
from ._rclpy_pybind11 import UnsupportedEventTypeError
from .logging import get_logger
from .qos import qos_policy_name_from_kind
from .waitable import NumberOfEntities, Waitable, WaitSet

if TYPE_CHECKING:
    from turtlewire.wire import base

    from ._execution.handle import Handle
    from .callback_groups import CallbackGroup
    from .impl.rcutils_logger import RcutilsLogger
    from .publisher import Publisher
    from .subscription import Subscription

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
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSPublisherMatchedInfo",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]


class _Event(Entity):
    """An event of the middleware, as the part of a waitable."""

    def __init__(self, wire: base.Event) -> None:
        super().__init__(None)
        self._wire = wire

    def _attach(self, host: EntityHost) -> None:
        host.wait.watch(self._wire, self)

    def _detach(self, host: EntityHost) -> None:
        host.wait.unwatch(self._wire)

    def _take(self) -> None:
        """The handler takes it."""

    def _close(self) -> None:
        self._wire.close()


class EventHandler(Waitable):
    """Calls ``callback(info)`` on the executor when the event happened.

    Args:
        callback_group: Of the callback.
        callback: Function to call.
        event_type: Which event.
        parent_impl: The publisher or subscription, or its handle.

    Raises:
        UnsupportedEventTypeError: The middleware cannot report it.
    """

    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[[Any], Any],
        event_type: QoSPublisherEventType | QoSSubscriptionEventType,
        parent_impl: Publisher[Any] | Subscription[Any] | Handle,
    ) -> None:
        super().__init__(callback_group)
        self.callback = callback
        self.event_type = event_type
        kind, self._info = report(event_type)
        try:
            self._event = parent_impl._wire.create_event(kind)
        except WireError as error:
            raise UnsupportedEventTypeError(str(error)) from error
        self._part = _Event(self._event)

    def get_num_entities(self) -> NumberOfEntities:
        return NumberOfEntities(num_events=1)

    def add_to_wait_set(self, wait_set: WaitSet) -> None:
        self._index = wait_set.add_event(self._part)

    def is_ready(self, wait_set: WaitSet) -> bool:
        return wait_set.is_ready("event", self._index)

    def take_data(self) -> Any:
        """Return the event's info; None if the event was taken already."""
        status = self._event.take()
        return None if status is None else self._info(status)

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


# Lyrical no longer has it.
if not since(LYRICAL):

    class QoSEventHandler(EventHandler):
        """The former name of :class:`EventHandler`; creating one warns."""

        def __init__(self, *args: Any, **kwargs: Any) -> None:
            import warnings

            warnings.warn(
                "QoSEventHandler is deprecated, use EventHandler instead",
                DeprecationWarning,
                stacklevel=2,
            )
            super().__init__(*args, **kwargs)


#: Callbacks by event, None where the program wants none.
_Wanted = dict["QoSPublisherEventType | QoSSubscriptionEventType", "Callable[[Any], None] | None"]


class _EventCallbacks:
    """The common base of the event callbacks of publishers and subscriptions."""

    #: How ROS 2 warns of an endpoint that does not match.
    _WARNING = ""

    #: The event of it.
    _INCOMPATIBLE: QoSPublisherEventType | QoSSubscriptionEventType

    incompatible_qos: Callable[[Any], None] | None
    use_default_callbacks: bool

    def _wanted(self) -> _Wanted:
        raise NotImplementedError

    def _make_handlers(
        self,
        callback_group: CallbackGroup,
        endpoint: Publisher[Any] | Subscription[Any],
        topic_name: str,
    ) -> list[EventHandler]:
        def handler(event_type: Any, callback: Callable[[Any], None]) -> EventHandler:
            return EventHandler(
                callback_group=callback_group,
                callback=callback,
                event_type=event_type,
                parent_impl=endpoint,
            )

        handlers = [
            handler(event_type, callback)
            for event_type, callback in self._wanted().items()
            if callback is not None
        ]
        if (
            self.incompatible_qos is None
            and self.use_default_callbacks
            # On Zenoh all endpoints match, so the handler would only cost time.
            and EventKind.INCOMPATIBLE_QOS in endpoint._core.context.wire.events
        ):
            warn = self._warn_of_incompatible_qos(topic_name, get_logger(endpoint.logger_name))
            handlers.append(handler(self._INCOMPATIBLE, warn))
        return handlers

    def _warn_of_incompatible_qos(
        self, topic_name: str, logger: RcutilsLogger
    ) -> Callable[[Any], None]:
        text = self._WARNING

        def warn(event: QoSRequestedIncompatibleQoSInfo | QoSOfferedIncompatibleQoSInfo) -> None:
            logger.warning(
                text.format(topic_name, qos_policy_name_from_kind(event.last_policy_kind))
            )

        return warn


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a subscription.

    Each callback gets the info of its event.

    Args:
        deadline: No message came in time (:class:`QoSDeadlineRequestedInfo`).
        incompatible_qos: A publisher does not match (:class:`QoSRequestedIncompatibleQoSInfo`).
        liveliness: A publisher came, went, or fell silent (:class:`QoSLivelinessChangedInfo`).
        message_lost: :class:`QoSMessageLostInfo`.
        incompatible_type: Accepted, and never called: no middleware here reports it.
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

    _INCOMPATIBLE = QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS

    def create_event_handlers(
        self, callback_group: CallbackGroup, subscription: Subscription[Any], topic_name: str
    ) -> list[EventHandler]:
        """Make a handler for each callback; called by the node when it creates the subscription.

        Raises:
            UnsupportedEventTypeError: The middleware cannot report one of the events.
        """
        return self._make_handlers(callback_group, subscription, topic_name)

    def _wanted(self) -> _Wanted:
        event = QoSSubscriptionEventType
        return {
            event.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED: self.deadline,
            event.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS: self.incompatible_qos,
            event.RCL_SUBSCRIPTION_LIVELINESS_CHANGED: self.liveliness,
            event.RCL_SUBSCRIPTION_MESSAGE_LOST: self.message_lost,
            event.RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE: self.incompatible_type,
            event.RCL_SUBSCRIPTION_MATCHED: self.matched,
        }


class PublisherEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a publisher; each gets the info of its event.

    Args:
        deadline: No message was sent in time (:class:`QoSDeadlineOfferedInfo`).
        incompatible_qos: A subscription does not match (:class:`QoSOfferedIncompatibleQoSInfo`).
        liveliness: It did not say in time that it is alive (:class:`QoSLivelinessLostInfo`).
        incompatible_type: Accepted, and never called: no middleware here reports it.
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

    _INCOMPATIBLE = QoSPublisherEventType.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS

    def create_event_handlers(
        self, callback_group: CallbackGroup, publisher: Publisher[Any], topic_name: str
    ) -> list[EventHandler]:
        """Make a handler for each callback; called by the node when it creates the publisher.

        Raises:
            UnsupportedEventTypeError: The middleware cannot report one of the events.
        """
        return self._make_handlers(callback_group, publisher, topic_name)

    def _wanted(self) -> _Wanted:
        event = QoSPublisherEventType
        return {
            event.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED: self.deadline,
            event.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS: self.incompatible_qos,
            event.RCL_PUBLISHER_LIVELINESS_LOST: self.liveliness,
            event.RCL_PUBLISHER_INCOMPATIBLE_TYPE: self.incompatible_type,
            event.RCL_PUBLISHER_MATCHED: self.matched,
        }
