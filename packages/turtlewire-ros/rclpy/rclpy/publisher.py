"""Publishers."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, Protocol

from turtlewire.errors import WireError
from turtlewire.msg.cdr import encode
from turtlewire.wire.qos import BEST_AVAILABLE_NS

from ._execution.handle import Handle
from ._qos.policies import DurabilityPolicy, LivelinessPolicy
from ._rclpy_pybind11 import InvalidHandle, RCLError
from ._typing import MsgT
from ._typing import MsgT as MsgType
from .duration import Duration

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.wire import base

    from ._execution.handle import EndpointImpl
    from .callback_groups import CallbackGroup
    from .qos import QoSProfile

__all__ = ["BasePublisher", "MsgType", "Publisher"]


_SLICE_NS = 100_000_000
_NO_LIMIT = Duration(seconds=-1)


class _EventCallbacks(Protocol):
    """The part of :class:`rclpy.event_handler.PublisherEventCallbacks` that is used here."""

    def create_event_handlers(
        self, callback_group: CallbackGroup, publisher: Publisher[Any], topic_name: str, /
    ) -> list[Any]: ...


class BasePublisher(Generic[MsgT]):
    """Sends messages to a topic. Thread-safe.

    Args:
        publisher_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        qos_profile: Its quality of service.
        on_destroy: Called with the publisher after it has been destroyed.

    Attributes:
        msg_type: Class of its messages.
        qos_profile: Its quality of service.
    """

    def __init__(
        self,
        publisher_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        qos_profile: QoSProfile,
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        wire, core = publisher_impl
        self.msg_type = msg_type
        self.qos_profile = qos_profile
        self.topic = topic
        self._wire: base.Publisher = wire
        self._core = core
        self._context = core.context
        self._sends_always = (  # late joiners, deadlines and liveliness count every message
            qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
            or qos_profile.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
            or 0 < qos_profile.deadline.nanoseconds < BEST_AVAILABLE_NS
        )
        # The first message is encoded even if nobody listens: a field that its type cannot hold is
        # an error at the line that publishes it, and not later, when another program looks at it.
        self._checked = False
        self._destroyed = False
        self._on_destroy = on_destroy

    def publish(self, msg: MsgT | bytes) -> None:
        """Send a message, or bytes that are one in CDR already.

        While the topic has no subscription, only the first message is encoded, to check it.

        Raises:
            TypeError: ``msg`` is neither a ``msg_type`` nor ``bytes``.
            CdrError: A field holds what its type cannot.
            InvalidHandle: The publisher was destroyed, perhaps by another thread during the call.
            RCLError: The context was shut down, or the middleware reported an error.
        """
        if self._destroyed:
            self._check_usable()
        if isinstance(msg, self.msg_type):
            if not (self._sends_always or self._wire.is_heard()):
                # After a shutdown, publishing is an error even if nothing would be sent.
                self._check_context("Failed to publish")
                if not self._checked:
                    encode(msg)
                    self._checked = True
                return
            cdr = encode(msg)
        elif isinstance(msg, bytes):
            cdr = msg
        else:
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        try:
            self._wire.publish(cdr)
        except WireError as error:
            self._check_usable()  # raises if another thread has destroyed the publisher
            self._check_context("Failed to publish")
            raise RCLError(f"Failed to publish: {error}") from error

    @property
    def _rclpy_outlet(self) -> base.Outlet | None:
        """Return the sender for native code; None if the middleware has none."""
        return self._wire.outlet()

    def _check_context(self, failure: str) -> None:
        if not self._context.is_open():
            raise RCLError(f"{failure}: publisher's context is invalid") from None

    def get_subscription_count(self) -> int:
        """Return the number of matching subscriptions that are known now."""
        self._check_usable()
        self._check_context("failed to get subscription count")
        return self._wire.subscription_count()

    @property
    def topic_name(self) -> str:
        """Fully qualified name of the topic."""
        self._check_usable()
        return self._wire.topic

    @property
    def handle(self) -> Handle:
        """A stand-in for ROS 2's C object."""
        self._check_usable()
        return Handle(self)

    @property
    def logger_name(self) -> str:
        """Name of the logger of its node."""
        return self._core.logger.name

    def assert_liveliness(self) -> None:
        """Say that this publisher is alive (``LivelinessPolicy.MANUAL_BY_TOPIC``)."""
        self._check_usable()
        self._check_context("Failed to assert liveliness on the Publisher")
        self._wire.assert_liveliness()

    def destroy(self) -> None:
        """Close it; further use raises ``InvalidHandle``. Idempotent."""
        if self._destroyed:
            return
        self._destroyed = True
        self._wire.close()
        if self._on_destroy is not None:
            self._on_destroy(self)

    def _check_usable(self) -> None:
        if self._destroyed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, exc_type: object, exc_val: object, exc_tb: object) -> None:
        self.destroy()


class Publisher(BasePublisher[MsgT]):
    """Sends messages to a topic.

    Made by :meth:`Node.create_publisher <rclpy.node.Node.create_publisher>`, which takes a derived
    class, too. Thread-safe.

    Args:
        publisher_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        qos_profile: Its quality of service.
        event_callbacks: Functions to call on events of the quality of service.
        callback_group: The group in which they are called.
        on_destroy: Called with the publisher after it has been destroyed.
    """

    def __init__(
        self,
        publisher_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        qos_profile: QoSProfile,
        event_callbacks: _EventCallbacks | None = None,
        callback_group: CallbackGroup | None = None,
        *,
        on_destroy: Callable[[Any], None] | None = None,
    ) -> None:
        super().__init__(publisher_impl, msg_type, topic, qos_profile, on_destroy=on_destroy)
        self.event_handlers: list[Any] = []
        if event_callbacks is not None and callback_group is not None:
            # ROS 2 names the topic in its warnings as it was given.
            self.event_handlers = event_callbacks.create_event_handlers(callback_group, self, topic)

    def wait_for_all_acked(self, timeout: Duration = _NO_LIMIT) -> bool:
        """Block until all reliable subscriptions have received all messages.

        Args:
            timeout: Negative waits until the context is shut down.

        Returns:
            False when the time was over, or the context was shut down, before.
        """
        self._check_usable()
        self._check_context("Failed to wait for all acknowledgements")
        deadline_ns = None if timeout.nanoseconds < 0 else time.monotonic_ns() + timeout.nanoseconds
        while True:  # in slices: neither a signal nor a shutdown ends the middleware's wait
            remaining_ns = (
                _SLICE_NS if deadline_ns is None else max(0, deadline_ns - time.monotonic_ns())
            )
            if self._wire.wait_for_acknowledgments(min(remaining_ns, _SLICE_NS)):
                return True
            if remaining_ns == 0 or not self._context.ok():
                return False

    def destroy(self) -> None:
        """Close it; further use raises ``InvalidHandle``. Idempotent."""
        for handler in self.event_handlers:
            handler.destroy()
        super().destroy()
