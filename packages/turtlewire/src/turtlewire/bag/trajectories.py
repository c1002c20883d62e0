"""Trajectories from the topics of a bag: odometry and poses."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.bag.message_choice import window
from turtlewire.bag.progress import progress_line
from turtlewire.bag.reader import Bag
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.trajectory.stamps import find_gaps

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from turtlewire.tf.datetimes import Span, Stamp
    from turtlewire.trajectory.stamps import Gap

__all__ = ["POSE_TYPES", "pose_topics", "read_topic"]

#: The part of a message that is the pose, and whether it names the frame that moves.
POSE_TYPES: dict[str, tuple[str, bool]] = {
    "geometry_msgs/msg/PoseStamped": ("pose", False),
    "geometry_msgs/msg/PoseWithCovarianceStamped": ("pose.pose", False),
    "geometry_msgs/msg/TransformStamped": ("transform", True),
    "nav_msgs/msg/Odometry": ("pose.pose", True),
}


def read_topic(
    path: str | os.PathLike[str],
    topic: str,
    times: tuple[Stamp | None, Stamp | None],
    max_gap_ns: Span | None,
    progress: Callable[[float], None] | None,
) -> tuple[NDArray[np.int64], NDArray[np.float64], str, str, tuple[Gap, ...]]:
    """Return stamps, poses, frames and gaps of a topic; see `Trajectory.from_bag`."""
    start_ns, end_ns = window(*times)
    with Bag(path) as bag:
        kind = _type_of(bag, topic)
        count = bag.topics[topic].message_count or 1
        tell = progress or progress_line(f"reading {topic}")
        rows = list(_rows(bag, topic, *POSE_TYPES[kind], (start_ns, end_ns, count), tell))
        tell(1.0)
    if not rows:
        raise BagError(f"{bag.path} has no message of {topic} in that time").with_hint(
            f"The bag covers {bag.start_ns} to {bag.end_ns}."
        )
    _, frame, child, _ = rows[0]
    stamps, first = np.unique(np.array([row[0] for row in rows], np.int64), return_index=True)
    poses = np.array([row[3] for row in rows], np.float64)[first]
    if len(first) < len(rows):
        warnings.warn(
            f"{bag.path}: {len(rows) - len(first):,} of {len(rows):,} messages of {topic} "
            "repeat a stamp; the first pose of each stamp is used",
            stacklevel=4,
        )
    return stamps, poses, frame, child, tuple(find_gaps(stamps, max_gap_ns))


def pose_topics(bag: Bag) -> list[str]:
    """Return the topics of a bag that `read_topic` reads."""
    return sorted(name for name, topic in bag.topics.items() if topic.type in POSE_TYPES)


def _type_of(bag: Bag, topic: str) -> str:
    fitting = pose_topics(bag)
    if topic in fitting:
        return bag.topics[topic].type
    has = f"Topics with poses: {', '.join(fitting)}." if fitting else "It has no topic with poses."
    if topic in bag.topics:
        wrong = bag.topics[topic].type
        if wrong == "tf2_msgs/msg/TFMessage":
            has = f"Buffer.from_bag({bag.path!r}).trajectory(target, source) reads transforms."
        raise BagError(f"{topic} is of type {wrong}, which has no poses").with_hint(has)
    hint = did_you_mean(topic, fitting)
    raise BagError(f"{bag.path} has no topic {topic}").with_hint(f"{hint}. {has}" if hint else has)


def _rows(
    bag: Bag,
    topic: str,
    place: str,
    has_child: bool,
    wanted: tuple[int, int, int],
    tell: Callable[[float], None],
) -> Iterator[tuple[int, str, str, tuple[float, ...]]]:
    """Stamp, frames and pose of each message."""
    start_ns, end_ns, count = wanted
    for number, message in enumerate(bag.messages(topic, start_ns=start_ns, end_ns=end_ns)):
        decoded: Any = message.decode()
        pose: Any = decoded
        for name in place.split("."):
            pose = getattr(pose, name)
        at = pose.translation if place == "transform" else pose.position
        turn = pose.rotation if place == "transform" else pose.orientation
        stamp = decoded.header.stamp.sec * 1_000_000_000 + decoded.header.stamp.nanosec
        child = decoded.child_frame_id if has_child else ""
        numbers = (at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w)
        yield stamp, decoded.header.frame_id, child, numbers
        if number % 1000 == 0:
            tell(min(1.0, number / count))
