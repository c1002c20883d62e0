"""The topics of transforms, and the type of their messages."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from turtlewire.wire.base import Graph

__all__ = [
    "TF_TYPE",
    "TfTopics",
    "as_options",
    "of_first_robot",
    "other_tf_topics",
    "refuse_other_types",
]

TF_TYPE = "tf2_msgs/msg/TFMessage"
_SAMPLE_TYPE = "geometry_msgs/msg/TransformStamped"
_NAMES = {"tf", "tf_static"}  # also in a robot's namespace


class TfTopics(NamedTuple):
    """The topics with the transforms of one robot, as fully qualified names."""

    moving: str = "/tf"
    static: str = "/tf_static"

    def __str__(self) -> str:
        return f"{self.moving} and {self.static}"


def other_tf_topics(graph: Graph, topics: TfTopics) -> list[str]:
    """Return the topics of transforms with publishers, apart from those that are known.

    Args:
        graph: The graph.
        topics: The topics to leave out.
    """
    published = {
        end.topic
        for end in graph.endpoints()
        if end.kind == "publisher" and end.type_name == TF_TYPE
    }
    return sorted(published - set(topics))


def of_first_robot(topics: list[str]) -> list[str]:
    """Return the topics in the namespace of the first one."""
    robot = topics[0].rpartition("/")[0]
    return [topic for topic in topics if topic.rpartition("/")[0] == robot]


def as_options(topics: Iterable[str]) -> str:
    """Return the options of a command that name topics of transforms."""
    return " ".join(
        f"{'--static-topic' if topic.endswith('_static') else '--topic'} {topic}"
        for topic in topics
    )


def refuse_other_types(topic: str, type_name: str) -> None:
    """Raise TypeError for messages on a topic of transforms that no listener would receive.

    Args:
        topic: The name of any topic.
        type_name: The type of its messages.
    """
    if topic.rpartition("/")[2] not in _NAMES or type_name == TF_TYPE:
        return
    remedy = ""
    if type_name == _SAMPLE_TYPE:
        remedy = "; put it into TFMessage(transforms=[...])"
    raise TypeError(f"{topic} carries {TF_TYPE}, not {type_name}{remedy}")
