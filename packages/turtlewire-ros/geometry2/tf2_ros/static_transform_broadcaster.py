"""Publishes static transforms, also for subscriptions that are created later."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from contextlib import suppress
from copy import deepcopy
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary, ref

from rclpy.exceptions import InvalidHandle
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from rclpy.serialization import serialize_message
from tf2_msgs.msg import TFMessage

from .transform_broadcaster import as_list

if TYPE_CHECKING:
    from geometry_msgs.msg import TransformStamped
    from rclpy.context import Context
    from rclpy.experimental import AsyncNode
    from rclpy.node import Node
    from rclpy.publisher import BasePublisher


class _Kept:
    """The transforms that one publisher keeps for late joiners."""

    def __init__(self, publisher: BasePublisher) -> None:
        # Its node owns it: a broadcaster that replaces a transform later must not keep it alive.
        self._publisher = ref(publisher)
        self.transforms: dict[str, TransformStamped] = {}

    @property
    def gone(self) -> bool:
        """True if nothing refers to the publisher any more."""
        return self._publisher() is None

    def publish(self) -> None:
        """Send all of it in one message, unless the publisher is gone or destroyed."""
        publisher = self._publisher()
        if publisher is not None:
            with suppress(InvalidHandle):
                publisher.publish(TFMessage(transforms=list(self.transforms.values())))


_lock = threading.Lock()
#: By context and topic, then by child frame: the publisher that keeps the transform, which is the
#: one that sent it last.
_keepers: WeakKeyDictionary[Context, dict[str, dict[str, _Kept]]] = WeakKeyDictionary()


class StaticTransformBroadcaster:
    """Publishes where frames stand that do not move. Thread-safe.

    All transforms are published in one message, because the publisher keeps one message for late
    joiners. A transform that is sent again replaces the earlier one, even if another broadcaster of
    this process sent that.

    Args:
        node: The publishing node.
        qos: Quality of service of ``/tf_static``, or a depth; by default depth 1 and transient
            local.

    Attributes:
        pub_tf: The publisher.
    """

    def __init__(self, node: Node | AsyncNode, qos: QoSProfile | int | None = None) -> None:
        if qos is None:
            qos = QoSProfile(
                depth=1,
                durability=DurabilityPolicy.TRANSIENT_LOCAL,
                history=HistoryPolicy.KEEP_LAST,
            )
        self.pub_tf = node.create_publisher(TFMessage, "/tf_static", qos)
        self._kept = _Kept(self.pub_tf)
        with _lock:
            self._keepers = _keepers.setdefault(node.context, {}).setdefault(
                self.pub_tf.topic_name, {}
            )
            # A destroyed publisher keeps no messages for late joiners.
            for child in [child for child, kept in self._keepers.items() if kept.gone]:
                del self._keepers[child]

    def sendTransform(  # noqa: N802 -- ROS 2's name
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Publish one or several transforms: poses of ``child_frame_id`` in ``header.frame_id``.

        They are copied; later changes of the messages have no effect until they are sent again.
        """
        transforms = deepcopy(as_list(transform))
        # A wrong field raises here, before it is kept and sent again with each later transform.
        serialize_message(TFMessage(transforms=transforms))
        with _lock:
            replaced = []
            for each in transforms:
                child = each.child_frame_id
                keeper = self._keepers.get(child, self._kept)
                if keeper is not self._kept:
                    del keeper.transforms[child]
                    replaced.append(keeper)
                self._keepers[child] = self._kept
                self._kept.transforms[child] = each
            # The replaced publishers as well: a late joiner must not get the old transform from
            # them.
            for keeper in (*replaced, self._kept):
                keeper.publish()
