"""Subscriptions."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING, Any, Generic, Protocol

from turtlewire.distro import KILTED, LYRICAL, since
from turtlewire.errors import CdrError
from turtlewire.msg import deserialize

from ._execution.entity import ClosingEntity, EntityHost, Work
from ._rclpy_pybind11 import RCLError
from ._typing import MsgT
from ._typing import MsgT as MsgType
from .impl.hints import with_hint
from .utilities import get_rmw_implementation_identifier

if TYPE_CHECKING:
    from turtlewire.wire import base

    from ._execution.handle import EndpointImpl
    from .callback_groups import CallbackGroup
    from .qos import QoSProfile
    from .subscription_content_filter_options import ContentFilterOptions

    class _EventCallbacks(Protocol):
        """The part of :class:`rclpy.event_handler.SubscriptionEventCallbacks` that is used here."""

        def create_event_handlers(
            self, callback_group: CallbackGroup, subscription: Subscription[Any], topic_name: str, /
        ) -> list[Any]: ...


__all__ = ["BaseSubscription", "MessageInfo", "MsgType", "Subscription"]


#: Second argument of a callback that takes two: facts about the message in addition to its content.
MessageInfo = dict[str, Any]


_CALLBACK_SHAPES = (  # ROS 2's text, to the byte
    "callback should be either be callable with one argument"
    "(to get only the message) or two (to get message and message info)"
)


class BaseSubscription(ClosingEntity, Generic[MsgT]):
    """Receives the messages of a topic.

    Args:
        subscription_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        callback: Called with each message, and with a message info when it takes two arguments.
        qos_profile: Its quality of service.
        raw: Whether the callback gets the serialized bytes instead of a message.
        on_destroy: Called with the subscription after it has been destroyed.

    Attributes:
        msg_type: Class of its messages.
        callback: Called with each message, and with a message info when it takes two arguments.
        raw: Whether the callback gets the serialized bytes instead of a message.
        qos_profile: Its quality of service.
    """

    _WRONG_CALLBACK = f"Subscription {_CALLBACK_SHAPES}"
    _names_publisher = since(KILTED)

    class CallbackType(Enum):
        """The number of arguments that a callback takes."""

        MessageOnly = 0
        WithMessageInfo = 1

    def __init__(
        self,
        subscription_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile,
        raw: bool,
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(None)
        wire, core = subscription_impl
        self._on_destroy = on_destroy
        self.msg_type = msg_type
        self.qos_profile = qos_profile
        self.raw = raw
        self.topic = topic
        self.event_handlers: list[Any] = []
        self.callback = callback
        self._wire: base.Subscription = wire
        self._core = core
        self._logger = core.logger

    @property
    def callback(self) -> Callable[..., Any]:
        """Callback for each message."""
        return self._callback

    @callback.setter
    def callback(self, value: Callable[..., Any]) -> None:
        self._callback_type = _callback_type(value, self._WRONG_CALLBACK)
        self._with_info = self._callback_type is BaseSubscription.CallbackType.WithMessageInfo
        self._callback = value

    @property
    def topic_name(self) -> str:
        """Fully qualified name of the topic."""
        self._check_usable()
        return self._wire.topic

    @property
    def logger_name(self) -> str:
        """Name of the logger of its node."""
        return self._core.logger.name

    def get_publisher_count(self) -> int:
        """Return the number of matching publishers that are known now."""
        self._check_usable()
        return self._wire.publisher_count()

    @property
    def is_cft_enabled(self) -> bool:
        """True if the middleware filters by content: it does not."""
        return False

    @property
    def is_cft_supported(self) -> bool:
        """True if the middleware could filter by content: it could not."""
        return False

    def set_content_filter(
        self,
        filter_expression: str,  # noqa: ARG002 - no middleware here filters
        expression_parameters: list[str],  # noqa: ARG002
    ) -> None:
        """Ask the middleware to leave out messages.

        Raises:
            RCLError: The middleware cannot filter, as ``is_cft_enabled`` says.
        """
        raise self._no_content_filter("set")

    def get_content_filter(self) -> ContentFilterOptions:
        """Return the filter of the middleware.

        Raises:
            RCLError: The middleware cannot filter, as ``is_cft_enabled`` says.
        """
        raise self._no_content_filter("get")

    def _no_content_filter(self, verb: str) -> RCLError:
        self._check_usable()
        return with_hint(
            RCLError(f"cannot {verb} the content filter: the middleware does not filter messages"),
            f"All messages of '{self._wire.topic}' arrive: filter them in the callback",
        )

    def _attach(self, host: EntityHost) -> None:
        host.wait.watch(self._wire, self)

    def _detach(self, host: EntityHost) -> None:
        host.wait.unwatch(self._wire)

    def take_message(
        self, _msg_type: Any = None, _raw: bool | None = None
    ) -> tuple[Any, MessageInfo] | None:
        """Return the next message and its info, or None; raise CdrError if it is malformed.

        For waitables, and for programs that look for messages themselves. ROS 2's handles need
        class and rawness as arguments, which ours know.
        """
        for cdr, info in self._wire.take(1):
            return (cdr if self.raw else deserialize(self.msg_type, cdr)), self._info(info)
        return None

    def _take(self) -> Work | None:
        for cdr, info in self._wire.take(1):
            try:
                message = cdr if self.raw else deserialize(self.msg_type, cdr)
            except CdrError as error:
                # The publisher's mistake must not end the spin of this program.
                self._logger.error(  # noqa: TRY400 - a ROS logger
                    f"Ignoring a malformed message on topic '{self._wire.topic}': {error}",
                    throttle_duration_sec=5.0,
                )
                return None
            return self._callback, ((message, self._info(info)) if self._with_info else (message,))
        return None

    def _info(self, info: base.MessageInfo) -> MessageInfo:
        values: MessageInfo = {
            "source_timestamp": info.source_timestamp_ns,
            "received_timestamp": info.received_timestamp_ns,
            "publication_sequence_number": info.publication_number,
            "reception_sequence_number": None,
        }
        if self._names_publisher:
            values["publisher_gid"] = {
                "implementation_identifier": get_rmw_implementation_identifier(),
                "data": info.publisher_gid,
            }
        return values

    def _close(self) -> None:
        for handler in self.event_handlers:
            handler.destroy()
        self._wire.close()


class Subscription(BaseSubscription[MsgT]):
    """Receives the messages of a topic.

    Made by :meth:`Node.create_subscription <rclpy.node.Node.create_subscription>`.

    Args:
        subscription_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        callback: Called with each message, and with a message info when it takes two arguments.
        qos_profile: Its quality of service.
        raw: Whether the callback gets the serialized bytes instead of a message.
        callback_group: The group of the subscription. Up to Kilted, it comes before the quality of
            service.
        event_callbacks: Functions to call on events of the quality of service.
        on_destroy: Called with the subscription after it has been destroyed.
    """

    _ORDER = 1

    def __init__(
        self,
        subscription_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile,
        raw: bool,
        *,
        on_destroy: Callable[[Any], None] | None = None,
        callback_group: CallbackGroup,
        event_callbacks: _EventCallbacks | None,
    ) -> None:
        super().__init__(
            subscription_impl, msg_type, topic, callback, qos_profile, raw, on_destroy=on_destroy
        )
        self._enter(callback_group)
        if event_callbacks is not None:
            # ROS 2 names the topic in its warnings as it was given.
            self.event_handlers = event_callbacks.create_event_handlers(callback_group, self, topic)

    if not (TYPE_CHECKING or since(LYRICAL)):
        _WRONG_CALLBACK = f"Subscription.__init__(): {_CALLBACK_SHAPES}"
        __init = __init__

        def __init__(  # in the order of Jazzy and Kilted
            self,
            subscription_impl: EndpointImpl,
            msg_type: type[MsgT],
            topic: str,
            callback: Callable[..., Any],
            callback_group: CallbackGroup,
            qos_profile: QoSProfile,
            raw: bool,
            event_callbacks: _EventCallbacks | None,
            *,
            on_destroy: Callable[[Any], None] | None = None,
        ) -> None:
            self.__init(
                subscription_impl,
                msg_type,
                topic,
                callback,
                qos_profile,
                raw,
                on_destroy=on_destroy,
                callback_group=callback_group,
                event_callbacks=event_callbacks,
            )


def _callback_type(callback: Callable[..., Any], failure: str) -> BaseSubscription.CallbackType:
    """Return the number of a callback's arguments, one or two.

    Raises:
        RuntimeError: The callback accepts neither; ``failure`` is the text.
    """
    # A plain function or method is checked without importing inspect.
    code = getattr(callback, "__code__", None)
    # The flags 0x0C mean `*args` and `**kwargs`.
    if code is not None and not code.co_flags & 0x0C and not hasattr(callback, "__wrapped__"):
        count = code.co_argcount - (1 if hasattr(callback, "__self__") else 0)
        required = count - len(callback.__defaults__ or ())
        if required == count and not code.co_kwonlyargcount and count in (1, 2):
            return BaseSubscription.CallbackType(count - 1)
    import inspect

    try:
        signature = inspect.signature(callback)
    except ValueError:  # a built-in function without one, such as `print` in Python 3.10
        return BaseSubscription.CallbackType.MessageOnly
    except TypeError:  # not callable at all
        raise RuntimeError(failure) from None
    for count in (1, 2):
        try:
            signature.bind(*(None,) * count)
        except TypeError:
            continue
        return BaseSubscription.CallbackType(count - 1)
    raise RuntimeError(failure)
