"""Fills a buffer with the transforms of ``/tf`` and ``/tf_static``."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from threading import Thread, current_thread
from typing import TYPE_CHECKING, Any

from rclpy._execution.background_events import BackgroundEvents
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from turtlewire.tf import listener as engine

from .buffer import JUMP_BACK, Buffer

if TYPE_CHECKING:
    from rclpy.clock import JumpHandle
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node
    from tf2_msgs.msg import TFMessage

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"
_FORGET_AFTER = "tf_forget_after"


class TransformListener:
    """Fills a buffer on a thread of the middleware: no executor has to spin for it.

    So a lookup may wait for a transform anywhere, also in a callback of a single-threaded executor.
    The listener works until it is unregistered or its node is destroyed, even if no reference to it
    is left.

    Args:
        buffer: The buffer to fill.
        node: The node that owns the subscriptions; None makes one in the default context.
        spin_thread: Spin the node in its own thread, for its other callbacks.
        qos: Quality of service of the subscription to ``tf_topic``, or a depth; by default depth
            100.
        static_qos: Quality of service of the subscription to ``tf_static_topic``; by default depth
            100 and transient local.
        tf_topic: The topic of transforms that change.
        tf_static_topic: The topic of static transforms.
        static_only: Subscribe to the static topic only.

    The node's parameter ``tf_forget_after`` (seconds, set from outside, as with ``--ros-args -p``)
    removes moving frames that long after their publisher has left the graph. ROS 2 keeps them.

    Attributes:
        buffer: The buffer.
        node: The node.
    """

    def __init__(
        self,
        buffer: Buffer,
        node: Node | AsyncNode | None,
        *,
        spin_thread: bool = False,
        qos: QoSProfile | int | None = None,
        static_qos: QoSProfile | int | None = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        static_only: bool = False,
    ) -> None:
        if not hasattr(buffer, "engine"):
            raise TypeError(
                f"TransformListener(buffer, node) takes the buffer first, not {type(buffer)}"
            )
        self.buffer = buffer
        self.node: Node | AsyncNode = _make_node() if node is None else node
        self._own_node = self.node if node is None else None
        self._on_destroy: Callable[[TransformListener], None] | None = None
        self._engine = engine.TransformListener(
            buffer.engine,
            self.node._rclpy_wire,
            context=self.node.context.wire,
            topic=None if static_only else self.node.resolve_topic_name(tf_topic),
            static_topic=self.node.resolve_topic_name(tf_static_topic),
            qos=_profile(qos, QoSProfile(depth=100)).to_wire(),
            static_qos=_profile(
                static_qos,
                QoSProfile(
                    depth=100,
                    durability=DurabilityPolicy.TRANSIENT_LOCAL,
                    history=HistoryPolicy.KEEP_LAST,
                ),
            ).to_wire(),
            forget_after_ns=_forget_after_ns(self.node),
        )
        self._follow_clock: JumpHandle | None = None
        # Otherwise the buffer follows the clock of its own node.
        if isinstance(buffer, Buffer) and buffer.node is None:
            self._follow_clock = self.node.get_clock().create_jump_callback(
                JUMP_BACK, post_callback=buffer.time_jump_callback
            )
        self._events = BackgroundEvents(self._engine)
        # The node holds both, because the listener works without any other reference to it.
        self.node._rclpy_endpoints.keep(self._events)
        self.node._rclpy_endpoints.keep(self)
        self._stop_closing = self.node._rclpy_endpoints.before_leaving(self._engine.close)
        self.executor: SingleThreadedExecutor | None = None
        self.dedicated_listener_thread: Thread | None = None
        if spin_thread:
            self.executor, self.dedicated_listener_thread = spin_in_thread(
                self.node, "transform-listener"
            )

    def unregister(self) -> None:
        """Stop listening; the buffer keeps its data. Idempotent."""
        self.destroy()

    def destroy(self) -> None:
        """:meth:`unregister`; the node calls it when it is destroyed."""
        self._events.destroy()
        self._engine.close()
        self._stop_closing()
        if self._follow_clock is not None:
            self._follow_clock.unregister()
        if self._on_destroy is not None:
            self._on_destroy(self)
            self._on_destroy = None
        if self.executor is not None:
            self.executor.shutdown()
        thread = self.dedicated_listener_thread
        # A callback may destroy the listener on its own thread.
        if thread is not None and thread is not current_thread():
            thread.join()
        if self._own_node is not None:
            node, self._own_node = self._own_node, None
            node.destroy_node()

    def callback(self, data: TFMessage) -> None:
        """Store the transforms of a message from another source, a bag for example."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, "default_authority")

    def static_callback(self, data: TFMessage) -> None:
        """:meth:`callback` for static transforms."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, "default_authority")


def _forget_after_ns(node: Node | AsyncNode) -> int | None:
    """Read the parameter; a node on which nobody has set it does not have it, as in ROS 2."""
    if not node.has_parameter(_FORGET_AFTER):
        if not node._parameters.has_override(_FORGET_AFTER):
            return None
        node.declare_parameter(_FORGET_AFTER, Parameter.Type.DOUBLE)
    seconds = node.get_parameter(_FORGET_AFTER).value
    return None if seconds is None else round(seconds * 1e9)


def _make_node() -> Any:
    from rclpy.node import Node

    name = engine.new_node_name()
    return Node(name, enable_rosout=False, start_parameter_services=False)


def _profile(qos: QoSProfile | int | None, default: QoSProfile) -> QoSProfile:
    if qos is None:
        return default
    return qos if isinstance(qos, QoSProfile) else QoSProfile(depth=qos)


def spin_in_thread(node: Node | AsyncNode, name: str) -> tuple[SingleThreadedExecutor, Thread]:
    """Spin a node in a daemon thread, until its executor or its context is shut down.

    Raises:
        TypeError: The node is asynchronous.
    """
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)  # type: ignore[arg-type]  # raises if it is asynchronous
    thread = Thread(target=_spin, args=(executor,), name=name, daemon=True)
    thread.start()
    return executor, thread


def _spin(executor: SingleThreadedExecutor) -> None:
    with suppress(ExternalShutdownException):
        executor.spin()
