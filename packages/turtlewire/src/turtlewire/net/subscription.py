"""Messages in."""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import TYPE_CHECKING, Generic

from turtlewire import msg
from turtlewire.call_errors import hint_at
from turtlewire.errors import InterfaceError
from turtlewire.msg.message import MessageT
from turtlewire.wake_up import LoopWakeUp, WakeUp
from turtlewire.wire.base import TypeId
from turtlewire.wire.conflicts import warn_of_types
from turtlewire.wire.qos import BEST_AVAILABLE_NS, Durability, QoS, Reliability, fit_subscription

if TYPE_CHECKING:
    from typing_extensions import Self

    from turtlewire.wire import base
    from turtlewire.wire.records import MessageInfo

#: A subscription that matches the existing publishers.
_FITTING = QoS(
    reliability=Reliability.BEST_AVAILABLE,
    durability=Durability.BEST_AVAILABLE,
    deadline_ns=BEST_AVAILABLE_NS,
)


@hint_at(
    {
        "get recv receive take next read": "`for message in subscription`, or latest()",
        "callback add_callback on_message": "`for message in subscription`; there are no callbacks",
    }
)
class Subscription(Generic[MessageT]):
    """The messages of one topic: iterate with ``for`` on any thread, or with ``async for``.

    It keeps as many messages as the depth of its QoS; a newer one drops the oldest. Iterations end
    when it is closed, and several of them share the messages. Thread-safe.

    Attributes:
        topic: Its fully qualified name.
        dropped: How many received messages were dropped before they were read. In a burst, the
            middleware may drop others before this object receives them.
    """

    def __init__(
        self,
        context: base.Context,
        node: base.Node,
        topic: str,
        message_type: type[MessageT] | None,
        qos: QoS | None,
        on_close: Callable[[Subscription[MessageT]], None],
    ) -> None:
        self._on_close = on_close
        self._context = context
        self._node = node
        self._type = message_type
        self._qos = qos
        self.topic = topic
        self.dropped = 0
        self._lock = threading.Lock()
        self._messages: deque[bytes] = deque(maxlen=max(1, (qos or _FITTING).depth))
        self._newest: bytes | None = None
        self._waits: set[Callable[[], object]] = set()
        self._wire: base.Subscription | None = None
        self._fault: InterfaceError | None = None
        self._closed = False
        self._stop: Callable[[], None] | None = None
        if message_type is not None and qos is not None:
            self._begin(message_type, qos)
        else:
            self._stop = context.graph.add_listener(self._look)
            context.call_soon(self._look)  # a publisher may be known already

    def _look(self) -> None:
        """Begin when a publisher is known; runs on the reader thread of the wire."""
        if self._wire is not None or self._fault is not None or self._closed:
            return
        wanted = None if self._type is None else msg.type_name(self._type)
        publishers = self._context.graph.endpoints_of(self.topic, "publisher")
        offered = [end for end in publishers if wanted is None or end.type_name == wanted]
        if not offered:
            if wanted is not None and publishers:  # the wire does not know of this subscription
                others = {end.type_name for end in publishers}
                warn_of_types(self.topic, "subscription", wanted, others)
            return
        try:
            message_type = self._type or msg.get_message(offered[0].type_name)
        except InterfaceError as error:
            self._fault = error
            self._notify()
            return
        fitting = fit_subscription(
            _FITTING, [end.qos for end in offered if end.type_name == offered[0].type_name]
        )
        self._begin(message_type, self._qos or fitting)

    def _begin(self, message_type: type[MessageT], qos: QoS) -> None:
        name = msg.type_name(message_type)
        self._type = message_type
        self._wire = self._node.create_subscription(
            self.topic, TypeId(name, msg.type_hash(name)), qos, self._receive
        )
        if self._closed:  # by another thread, which has not seen it
            self._wire.close()

    def _receive(self, cdr: bytes, _info: MessageInfo) -> None:
        with self._lock:
            self.dropped += len(self._messages) == self._messages.maxlen
            self._messages.append(cdr)
            self._newest = cdr
        self._notify()

    def _notify(self) -> None:
        with self._lock:
            waits, self._waits = self._waits, set()
        for wake in waits:
            wake()

    def _next(self, wake: Callable[[], object]) -> bytes | None:
        """Return the next message, or None to wait until ``wake()`` is called.

        Raises:
            StopIteration: The subscription is closed, and all messages are read.
        """
        with self._lock:
            if self._messages:
                return self._messages.popleft()
            if self._fault is not None:
                raise self._fault
            if self._closed:
                raise StopIteration
            self._waits.add(wake)
            return None

    def _forget(self, wake: Callable[[], object]) -> None:
        with self._lock:
            self._waits.discard(wake)

    def _decoded(self, cdr: bytes) -> MessageT:
        assert self._type is not None
        return msg.deserialize(self._type, cdr)

    def latest(self) -> MessageT | None:
        """Return the newest message, also one that was read before; None before the first."""
        newest = self._newest
        return None if newest is None else self._decoded(newest)

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> MessageT:
        changed = WakeUp()
        wake = changed.set
        try:
            while (cdr := self._next(wake)) is None:
                changed.wait()
        finally:
            self._forget(wake)
        return self._decoded(cdr)

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> MessageT:
        changed = LoopWakeUp(asyncio.get_running_loop())
        wake = changed.set
        try:
            while (cdr := self._next(wake)) is None:
                await changed.wait()
        except StopIteration:
            raise StopAsyncIteration from None
        finally:
            self._forget(wake)
        return self._decoded(cdr)

    def close(self) -> None:
        """Leave the topic, and end the iterations. Idempotent."""
        with self._lock:
            self._closed = True
        if self._stop is not None:
            self._stop()
        if self._wire is not None:
            self._wire.close()
        self._notify()
        self._on_close(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
