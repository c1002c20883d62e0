"""Waits until messages have come on topics."""

from __future__ import annotations

import collections
import threading
import uuid
from collections.abc import Callable, Iterable
from types import TracebackType
from typing import TYPE_CHECKING, Any

import rclpy
from launch_testing_ros.message_pump import MessagePump
from rclpy.context import Context

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy.qos import QoSProfile


class WaitForTopics:
    """Subscribes to topics and waits for a message on each.

    ``with WaitForTopics([("chatter", String)]) as topics:`` waits at the beginning. It has its own
    node and context.

    Args:
        topic_tuples: Names and types of the topics.
        timeout: Seconds to wait at most.
        messages_received_buffer_length: How many messages of each topic are kept.
        trigger: Called by :meth:`wait` once the subscriptions exist, with their node and the
            arguments of :meth:`wait`.
        node_namespace: Namespace of the node.
        qos_profile: Quality of service of the subscriptions, or their depth.
    """

    def __init__(
        self,
        topic_tuples: Iterable[tuple[str, Any]],
        timeout: float = 5.0,
        messages_received_buffer_length: int = 10,
        trigger: Callable[..., Any] | None = None,
        node_namespace: str | None = None,
        qos_profile: QoSProfile | int = 10,
    ) -> None:
        self.topic_tuples = list(topic_tuples)
        self.timeout = timeout
        self._length = messages_received_buffer_length
        self._trigger = trigger
        self._qos_profile = qos_profile
        self._messages: dict[str, collections.deque[Any]] = {}
        self._changed = threading.Condition()
        self._context = Context()
        rclpy.init(context=self._context)
        name = f"wait_for_topics_{uuid.uuid4().hex[:12]}"
        self._node = rclpy.create_node(name, context=self._context, namespace=node_namespace)
        for topic, kind in self.topic_tuples:
            self._subscribe(topic, kind)
        self._pump = MessagePump(self._node, context=self._context)
        self._pump.start()

    def _subscribe(self, topic: str, kind: Any) -> None:
        def keep(message: Any) -> None:
            with self._changed:
                kept = self._messages.setdefault(topic, collections.deque(maxlen=self._length))
                kept.append(message)
                self._changed.notify_all()

        self._node.create_subscription(kind, topic, keep, self._qos_profile)

    def wait(self, *args: Any, **kwargs: Any) -> bool:
        """Call the trigger, then wait; return True if each topic had a message in time.

        Args:
            *args: For the trigger.
            **kwargs: For the trigger.
        """
        if self._trigger is not None:
            self._trigger(self._node, *args, **kwargs)
        with self._changed:
            # A topic may be given with several types, so count its name once.
            return self._changed.wait_for(
                lambda: len(self._messages) == len(dict(self.topic_tuples)), self.timeout
            )

    def topics_received(self) -> set[str]:
        """Return the topics that had a message."""
        with self._changed:
            return set(self._messages)

    def topics_not_received(self) -> set[str]:
        """Return the topics that had no message."""
        return {topic for topic, _ in self.topic_tuples} - self.topics_received()

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the last messages of a topic.

        Raises:
            KeyError: The topic was not requested.
        """
        if topic_name not in dict(self.topic_tuples):
            known = ", ".join(topic for topic, _ in self.topic_tuples)
            raise KeyError(f"'{topic_name}' is not one of the topics: {known}")
        with self._changed:
            return list(self._messages.get(topic_name, ()))

    def shutdown(self) -> None:
        """Destroy node and context."""
        self._pump.stop()
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def __enter__(self) -> Self:
        if not self.wait():
            missing = self.topics_not_received()
            self.shutdown()
            # Two arguments instead of one text, as in ROS 2: tests read the topics from `args`.
            raise RuntimeError("Did not receive messages on these topics: ", missing)
        return self

    def __exit__(
        self,
        exep_type: type[BaseException] | None,
        exep_value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.shutdown()
