"""Publishers."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Generic

from turtlewire.errors import WireError
from turtlewire.msg import encode
from turtlewire.wire.qos import BEST_AVAILABLE_NS

from ._execution.handle import Handle
from ._qos.policies import DurabilityPolicy, LivelinessPolicy
from ._rclpy_pybind11 import InvalidHandle, RCLError
from ._typing import MsgT
from ._typing import MsgT as MsgType
from .duration import Duration

if TYPE_CHECKING:
    from collections.abc import Callable

    from typing_extensions import Self

    from turtlewire.wire import base

    from ._node.state import NodeState
    from .qos import QoSProfile

__all__ = ["MsgType", "Publisher"]


_SLICE_NS = 100_000_000
_NO_LIMIT = Duration(seconds=-1)


class Publisher(Generic[MsgT]):
    """Sends messages to a topic.

    Made by :meth:`Node.create_publisher <rclpy.node.Node.create_publisher>`. Thread-safe.

    Attributes:
        msg_type: Class of its messages.
        qos_profile: Its quality of service.
    """

    def __init__(
        self, wire: base.Publisher, msg_type: type[MsgT], qos_profile: QoSProfile, core: NodeState
    ) -> None:
        self.msg_type = msg_type
        self.qos_profile = qos_profile
        self.topic = wire.topic
        self.event_handlers: list[Any] = []
        self._wire = wire
        self._core = core
        self._context = core.context
        self._sends_always = (  # late joiners, deadlines and liveliness count every message
            qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
            or qos_profile.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC
            or 0 < qos_profile.deadline.nanoseconds < BEST_AVAILABLE_NS
        )
        self._destroyed = False
        self._on_destroy: Callable[[Any], None] | None = None

    def publish(self, msg: MsgT | bytes) -> None:
        """Send a message, or bytes that are one in CDR already.

        It is not encoded while nobody is there to receive it.

        Raises:
            TypeError: ``msg`` is neither a ``msg_type`` nor ``bytes``.
            CdrError: A field holds what its type cannot.
            InvalidHandle: It was destroyed, perhaps meanwhile and by another thread.
            RCLError: The context was shut down, or the middleware refused it.
        """
        if self._destroyed:
            self._check_usable()
        if isinstance(msg, self.msg_type):
            if not (self._sends_always or self._wire.is_heard()):
                self._check_context()
                return
            cdr = encode(msg)
        elif isinstance(msg, bytes):
            cdr = msg
        else:
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        try:
            self._wire.publish(cdr)
        except WireError as error:
            self._check_usable()  # another thread may have destroyed it meanwhile
            self._check_context()
            raise RCLError(f"Failed to publish: {error}") from error

    @property
    def _rclpy_outlet(self) -> base.Outlet | None:
        """Return the sender for native code; None if the middleware has none."""
        return self._wire.outlet()

    def _check_context(self) -> None:
        if not self._context.is_open():
            raise RCLError("Failed to publish: publisher's context is invalid") from None

    def get_subscription_count(self) -> int:
        """Return the number of matching subscriptions that are known now."""
        self._check_usable()
        return self._wire.subscription_count()

    @property
    def topic_name(self) -> str:
        """Fully qualified name of the topic."""
        self._check_usable()
        return self.topic

    @property
    def handle(self) -> Handle:
        """Stands for the C object that it has in ROS 2."""
        self._check_usable()
        return Handle(self)

    @property
    def logger_name(self) -> str:
        """Name of the logger of its node."""
        return self._core.logger.name

    def assert_liveliness(self) -> None:
        """Say that this publisher is alive (``LivelinessPolicy.MANUAL_BY_TOPIC``)."""
        self._check_usable()
        self._wire.assert_liveliness()

    def wait_for_all_acked(self, timeout: Duration = _NO_LIMIT) -> bool:
        """Block until all reliable subscriptions have received all messages.

        Args:
            timeout: Negative waits until the context is shut down.

        Returns:
            False when the time was over, or the context was shut down, before.
        """
        self._check_usable()
        deadline_ns = None if timeout.nanoseconds < 0 else time.monotonic_ns() + timeout.nanoseconds
        while True:  # in slices: the middleware's wait hears neither of signals nor of a shutdown
            remaining_ns = (
                _SLICE_NS if deadline_ns is None else max(0, deadline_ns - time.monotonic_ns())
            )
            if self._wire.wait_for_acknowledgments(min(remaining_ns, _SLICE_NS)):
                return True
            if remaining_ns == 0 or not self._context.ok():
                return False

    def destroy(self) -> None:
        """Close it; further use raises ``InvalidHandle``. Idempotent."""
        if self._destroyed:
            return
        self._destroyed = True
        for handler in self.event_handlers:
            handler.destroy()
        self._wire.close()
        if self._on_destroy is not None:
            self._on_destroy(self)

    def _check_usable(self) -> None:
        if self._destroyed:
            raise InvalidHandle("cannot use Destroyable because destruction was requested")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.destroy()
