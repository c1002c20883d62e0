"""The page's panels next to the field: ``ros2 topic echo``, ``tf2_echo`` and the doctor."""

from __future__ import annotations

from argparse import Namespace
from typing import TYPE_CHECKING, Any

from rclpy.time import Time
from rosidl_runtime_py import message_to_yaml
from rosidl_runtime_py.utilities import get_message
from tf2_ros import Buffer, TransformException, TransformListener
from tf2_ros.tf2_echo import describe
from turtlewire.doctor.examination import report
from turtlewire.doctor.graph_findings import graph_findings
from turtlewire.doctor.tf_findings import tf_findings
from turtlewire.doctor.tf_traffic import TfListener

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.subscription import Subscription

__all__ = ["Doctor", "TopicEcho", "TransformEcho", "topics_of"]

_ECHO_OPTIONS = Namespace(precision=3, degrees=False, distance=False)
_HIDDEN = {"/clock", "/parameter_events", "/rosout"}


def topics_of(node: Node) -> list[str]:
    """Topics with a publisher, for the list of the page."""
    return sorted(
        name
        for name, _ in node.get_topic_names_and_types()
        if name not in _HIDDEN and "/_action/" not in name and node.count_publishers(name)
    )


class TopicEcho:
    """The newest message of a topic, as ``ros2 topic echo`` prints it.

    Args:
        node: Subscribes.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._topic = ""
        self._subscription: Subscription[Any] | None = None
        self._newest: Any = None

    def text(self, topic: str) -> str:
        """Return the newest message; empty until one has come."""
        if topic != self._topic:
            self._change(topic)
        return "" if self._newest is None else f"{message_to_yaml(self._newest)}---"

    def _change(self, topic: str) -> None:
        publishers = self._node.get_publishers_info_by_topic(topic) if topic else []
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None
        self._newest = None
        self._topic = topic if publishers else ""  # asked for again until a node publishes it
        if publishers:
            self._subscription = self._node.create_subscription(
                get_message(publishers[0].topic_type),
                topic,
                self._take,
                publishers[0].qos_profile,
            )

    def _take(self, message: Any) -> None:
        self._newest = message


class TransformEcho:
    """A transform as ``tf2_echo`` prints it.

    Args:
        node: Listens.
    """

    def __init__(self, node: Node) -> None:
        self._buffer = Buffer(node=node)
        self._listener = TransformListener(self._buffer, node)

    def text(self, target: str, source: str) -> str:
        """Return the newest transform, or the error with its hint."""
        try:
            return describe(self._buffer.lookup_transform(target, source, Time()), _ECHO_OPTIONS)
        except TransformException as error:
            return f"{error}\n{error.hint}".strip()


class Doctor:
    """Listens to the transforms from now on, for a report of ``turtlewire doctor``.

    Args:
        node: A node of the graph that is examined.
    """

    def __init__(self, node: Node) -> None:
        self._wire = node.context.wire
        self._listener = TfListener(self._wire)

    def report(self) -> str:
        """Stop listening and say what is wrong."""
        traffic = self._listener.close()
        graph = self._wire.graph
        return report([*graph_findings(graph), *tf_findings(graph, traffic)])
