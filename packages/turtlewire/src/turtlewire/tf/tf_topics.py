"""The topics of transforms, and the type of their messages."""

from __future__ import annotations

__all__ = ["TF_TYPE", "refuse_other_types"]

TF_TYPE = "tf2_msgs/msg/TFMessage"
_SAMPLE_TYPE = "geometry_msgs/msg/TransformStamped"
_NAMES = {"tf", "tf_static"}  # also in a robot's namespace


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
