"""One participant of a ROS network, with a node."""

from __future__ import annotations

import asyncio
import threading
from types import TracebackType
from typing import TYPE_CHECKING, Any, TypeVar, overload

from turtlewire import msg, wire
from turtlewire.call_errors import explain_call, explain_calls, hint_at
from turtlewire.errors import WireError
from turtlewire.net.publisher import Broadcaster, Publisher
from turtlewire.net.subscription import Subscription
from turtlewire.tf.buffer import Buffer
from turtlewire.tf.datetimes import as_nanoseconds
from turtlewire.tf.listener import NOTHING_RECEIVED, STATIC_TOPIC, TOPIC, TransformListener
from turtlewire.tf.tf_topics import refuse_other_types
from turtlewire.wire import names
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

if TYPE_CHECKING:
    from typing import Protocol

    from typing_extensions import Self

    from turtlewire.geometry.quaternions import Numbers
    from turtlewire.msg.message import MessageT
    from turtlewire.tf.datetimes import Span, Stamp

    class Closes(Protocol):
        """An object that a connection closes."""

        def close(self) -> None:
            """Leave the network."""

    AnyClosing = TypeVar("AnyClosing", bound=Closes)

_NO_TURN = (0.0, 0.0, 0.0, 1.0)


@explain_call
def connect(
    name: str = "turtlewire",
    *,
    namespace: str = "/",
    domain_id: int | None = None,
    middleware: str | None = None,
) -> Connection:
    """Join a ROS network: publish, subscribe and receive transforms, without ROS.

    Args:
        name: The name of the node that others see.
        namespace: Its namespace, and that of relative topic names.
        domain_id: None uses ``ROS_DOMAIN_ID``, or 0.
        middleware: ``rmw_cyclonedds_cpp``, ``rmw_zenoh_cpp`` or ``local`` (inside this process);
            None uses the one of the environment.

    Raises:
        TypeError: A name is not a str, or the domain is not an int.
        ValueError: A name is not valid.
        WireError: The domain cannot be joined, or the middleware is not available.
    """
    _check_type("name", name, str)
    _check_type("namespace", namespace, str)
    if domain_id is not None:
        _check_type("domain_id", domain_id, int)
    for given, fault in (
        (name, names.validate_node_name(name)),
        (namespace, names.validate_namespace(namespace)),
    ):
        if fault is not None:
            raise ValueError(f"{given!r}: {fault.message}")
    return Connection(wire.open_context(domain_id, middleware=middleware), name, namespace)


@hint_at(
    {
        "create_subscription subscription listen on": "subscribe(topic)",
        "create_publisher advertise publish": "publisher(topic, type)",
        "sendTransform broadcast broadcaster": "send_transform",
        "buffer tf listener": "transforms()",
        "lookup_transform can_transform": "transforms(), whose buffer has this method",
        "get_topic_names_and_types": "topics()",
        "spin spin_once run": "`for message in connection.subscribe(topic)`; nothing has to spin",
        "destroy shutdown disconnect": "close()",
    }
)
@explain_calls
class Connection:
    """A participant of a ROS network, made by `connect`; a context manager. Thread-safe.

    ``async with`` closes it without blocking the event loop. Closing it ends the iterations over
    its subscriptions; the buffers of `transforms` keep their data.

    Attributes:
        name: The fully qualified name of its node.
    """

    def __init__(self, context: wire.base.Context, name: str, namespace: str) -> None:
        self._context = context
        self._base_name, self._namespace = name, namespace
        self.name = names.fully_qualified_node_name(name, namespace)
        self._node = context.create_node(name, namespace)
        self._broadcaster = Broadcaster(self._node)
        self._lock = threading.Lock()
        self._parts: dict[Closes, None] = {}  # in the order in which they were made
        self._closed = False

    # -- transforms

    def transforms(
        self,
        *,
        cache_time_ns: Span | None = 10_000_000_000,
        topic: str | None = TOPIC,
        static_topic: str | None = STATIC_TOPIC,
        forget_after_ns: Span | None = None,
    ) -> Buffer:
        """Return a buffer that is filled until the connection is closed.

        Args:
            cache_time_ns: How long samples are kept; None keeps everything.
            topic: Where transforms are published; None leaves them out.
            static_topic: Where static transforms are published; None leaves them out.
            forget_after_ns: Remove a moving frame this long after its publisher has left the
                graph; None keeps it, as tf2 does.
        """
        buffer = Buffer(_span_or_none(cache_time_ns, "cache_time_ns"))
        buffer._hint_if_empty = NOTHING_RECEIVED
        self._keep(
            TransformListener(
                buffer,
                self._node,
                context=self._context,
                topic=None if topic is None else self._full_name(topic),
                static_topic=None if static_topic is None else self._full_name(static_topic),
                forget_after_ns=_span_or_none(forget_after_ns, "forget_after_ns"),
            )
        )
        return buffer

    def send_transform(
        self,
        parent_frame: str,
        child_frame: str,
        stamp_ns: Stamp,
        translation: Numbers,
        rotation: Numbers = _NO_TURN,
    ) -> None:
        """Publish a transform; the arguments are the same as for `Buffer.set_transform`.

        Raises:
            InvalidTransformError: The transform is not valid.
        """
        self._check_open()
        self._broadcaster.send(parent_frame, child_frame, stamp_ns, translation, rotation)

    def send_static_transform(
        self,
        parent_frame: str,
        child_frame: str,
        translation: Numbers,
        rotation: Numbers = _NO_TURN,
    ) -> None:
        """Publish a transform that holds at all times, also for nodes that join later.

        Raises:
            InvalidTransformError: The transform is not valid.
        """
        self._check_open()
        self._broadcaster.send_static(parent_frame, child_frame, translation, rotation)

    # -- topics

    @overload
    def publisher(
        self, topic: str, type: type[MessageT], *, qos: QoS | None = None
    ) -> Publisher[MessageT]: ...
    @overload
    def publisher(
        self, topic: str, type: str, *, qos: QoS | None = None
    ) -> Publisher[msg.Message]: ...
    def publisher(
        self,
        topic: str,
        type: str | type[msg.Message],  # noqa: A002
        *,
        qos: QoS | None = None,
    ) -> Publisher:
        """Return a publisher.

        Args:
            topic: The name of the topic; relative names are in the namespace of the connection.
            type: The class of the messages, or its name: ``std_msgs/msg/String``.
            qos: None uses ROS 2's default: reliable, the last 10 messages.

        Raises:
            InterfaceError: The type does not exist.
            TypeError: An argument is of another type; or the topic is ``/tf`` or ``/tf_static``,
                and the type is not ``TFMessage``.
            ValueError: The name of the topic is not valid.
        """
        kind = _message_type(topic, type, "publisher")
        name = msg.type_name(kind)
        refuse_other_types(topic, name)
        if qos is not None:
            _check_type("qos", qos, QoS)
        publisher = self._node.create_publisher(
            self._full_name(topic), TypeId(name, msg.type_hash(name)), qos or QoS()
        )
        return self._keep(Publisher(publisher, self._context.graph, kind, self._forget))

    @overload
    def subscribe(
        self, topic: str, type: type[MessageT], *, qos: QoS | None = None
    ) -> Subscription[MessageT]: ...
    @overload
    def subscribe(
        self, topic: str, type: str | None = None, *, qos: QoS | None = None
    ) -> Subscription: ...
    def subscribe(
        self,
        topic: str,
        type: str | type[msg.Message] | None = None,  # noqa: A002
        *,
        qos: QoS | None = None,
    ) -> Subscription:
        """Return a subscription, to be iterated with ``for`` or ``async for``.

        Args:
            topic: The name of the topic; relative names are in the namespace of the connection.
            type: The class of the messages, or its name; None uses that of the first publisher.
            qos: None fits the publishers that are known when the first of them appears.

        Raises:
            InterfaceError: The type does not exist. A type that only a publisher names raises it
                from the iteration.
            TypeError: An argument is of another type; or the topic is ``/tf`` or ``/tf_static``,
                and the type is not ``TFMessage``.
            ValueError: The name of the topic is not valid.
        """
        kind = None if type is None else _message_type(topic, type, "subscribe")
        if kind is not None:
            refuse_other_types(topic, msg.type_name(kind))
        if qos is not None:
            _check_type("qos", qos, QoS)
        return self._keep(
            Subscription(
                self._context,
                self._node,
                self._full_name(topic),
                kind,
                qos,
                self._forget,
            )
        )

    def topics(self) -> dict[str, list[str]]:
        """Return the topics that are known now, each with its types.

        Raises:
            WireError: The connection is closed.
        """
        self._check_open()
        return self._context.graph.topic_names_and_types()

    # -- the end

    def close(self) -> None:
        """Leave the network, and end all iterations. Idempotent."""
        with self._lock:
            parts, self._parts = self._parts, {}
            self._closed = True
        for part in parts:
            part.close()
        self._context.close()

    def _keep(self, part: AnyClosing) -> AnyClosing:
        with self._lock:
            self._parts[part] = None
        return part

    def _forget(self, part: Closes) -> None:
        """Take a part out that its user has closed."""
        with self._lock:
            self._parts.pop(part, None)

    def _check_open(self) -> None:
        if self._closed:
            raise WireError(f"the connection {self.name} is closed").with_hint(
                "Call turtlewire.connect again, or do this before close() or the end of `with`."
            )

    def _full_name(self, topic: str) -> str:
        self._check_open()
        _check_type("topic", topic, str)
        fault = names.validate_topic_name(topic)
        if fault is not None:
            raise ValueError(f"{topic!r}: {fault.message}")
        full_name = names.expand_topic_name(topic, self._base_name, self._namespace)
        fault = names.validate_full_topic_name(full_name)
        if fault is not None:
            raise ValueError(f"{topic!r}: {fault.message}")
        return full_name

    def __enter__(self) -> Self:
        self._check_open()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    async def __aenter__(self) -> Self:
        self._check_open()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        await asyncio.to_thread(self.close)


def _span_or_none(value: Span | None, name: str) -> int | None:
    return None if value is None else as_nanoseconds(value, name)


def _message_type(topic: object, given: object, caller: str) -> type[Any]:
    """Return the class of the messages of a topic, by itself or by its name.

    Args:
        topic: The topic; only to find out whether it was swapped with the type.
        given: The class or its name.
        caller: The method of the connection that was called.

    Raises:
        InterfaceError: The type does not exist.
        TypeError: ``given`` is something else, topic and type are swapped, or the topic is not a
            str.
    """
    if _looks_like_a_type(topic) and isinstance(given, str) and not _looks_like_a_type(given):
        shown = topic.__name__ if isinstance(topic, type) else repr(topic)
        raise TypeError(f"topic and type are swapped: write {caller}({given!r}, {shown})")
    _check_type("topic", topic, str)
    if isinstance(given, str):
        return msg.get_message(given)
    if isinstance(given, type) and issubclass(given, msg.Message):
        return given
    if caller == "subscribe" and callable(given) and not isinstance(given, type):
        raise TypeError("subscribe() takes no callback; write `for message in subscription`")
    shown = f"the class {given.__name__}" if isinstance(given, type) else type(given).__name__
    raise TypeError(
        "type must be a class of messages or its name, for example 'std_msgs/msg/String', not "
        f"{shown}"
    )


def _looks_like_a_type(value: object) -> bool:
    if isinstance(value, str):
        parts = value.split("/")
        return len(parts) == 3 and all(parts) and parts[1] == "msg"
    return isinstance(value, type) and issubclass(value, msg.Message)


def _check_type(argument: str, value: object, wanted: type) -> None:
    """Raise TypeError if an argument is of another type."""
    if not isinstance(value, wanted):
        home = "" if wanted.__module__ == "builtins" else f"{wanted.__module__}."
        advice = "; write QoS(depth=...)" if argument == "qos" and isinstance(value, int) else ""
        given = type(value).__name__
        raise TypeError(f"{argument} must be {home}{wanted.__name__}, not {given}{advice}")
