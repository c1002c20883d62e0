"""Subscriptions of asynchronous nodes."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from rclpy._typing import MsgT
from rclpy.subscription import BaseSubscription

from ._async_entity import AsyncEndpoint, TaskGroup

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy._execution.handle import EndpointImpl
    from rclpy.qos import QoSProfile


class AsyncSubscription(AsyncEndpoint, BaseSubscription[MsgT]):
    """Receives the messages of a topic; made by :meth:`AsyncNode.create_subscription`.

    With a callback, each message waits in the middleware until the callback of the former one has
    ended, or is handled at once in a separate task if the subscription is concurrent. Without
    one, the program iterates over it: ``async for message in subscription``.

    Args:
        subscription_impl: The announced endpoint of the node.
        msg_type: Class of its messages.
        topic: Name of the topic, as it was given.
        callback: Called with each message, and with the message info if it takes two arguments.
            None (not in ROS 2): the program iterates.
        qos_profile: Its quality of service.
        on_destroy: Called with the subscription after it has been destroyed.
        raw: Whether messages are given as serialized bytes.
        concurrent: Whether a message may be handled while callbacks of former ones run.
        tg: Its tasks handle the messages; None if the node does not run yet.

    Attributes:
        msg_type: Class of its messages.
        raw: Whether messages are given as serialized bytes.
        qos_profile: Its quality of service.
    """

    _names_publisher = True

    def __init__(
        self,
        subscription_impl: EndpointImpl,
        msg_type: type[MsgT],
        topic: str,
        callback: Callable[..., Any] | None,
        qos_profile: QoSProfile,
        on_destroy: Callable[[Any], None] | None,
        raw: bool = False,
        concurrent: bool = False,
        tg: TaskGroup | None = None,
    ) -> None:
        self._is_iterated = callback is None
        self._turn = asyncio.Lock()  # several tasks may iterate
        self._concurrent = concurrent
        handler = _nothing if callback is None else callback
        super().__init__(
            subscription_impl, msg_type, topic, handler, qos_profile, raw, on_destroy=on_destroy
        )
        self._start(tg)

    def _start(self, group: TaskGroup | None) -> None:
        if not self._is_iterated:
            super()._start(group)

    def __aiter__(self) -> Self:
        """Iterate over the messages until the subscription is destroyed.

        Several iterations share the messages.

        Raises:
            RuntimeError: The subscription has a callback, which gets the messages.
        """
        if not self._is_iterated:
            raise RuntimeError(
                f"The messages of '{self.topic_name}' go to the callback of this subscription: "
                "create it with None as the callback to iterate over them"
            )
        return self

    async def __anext__(self) -> MsgT:
        async with self._turn:
            while not self._destroyed:
                work = self._take()
                if work is not None:
                    message: MsgT = work[1][0]
                    return message
                await self._until_ready()
        raise StopAsyncIteration


def _nothing(_message: Any) -> None:
    """Stand for the callback of a subscription that is iterated."""
