"""What buffers and transforms of both cores offer in Python: bags, trajectories, operators.

`equip` adds it to the classes of the core that is chosen. Bags and trajectories lie in rooms above
the buffer, so their code is imported by name, when it is first called.
"""

from __future__ import annotations

import weakref
from importlib import import_module
from typing import TYPE_CHECKING, Any

from turtlewire.geometry.poses import canonical, compose, interpolate

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator
    from typing import TypeVar

    from numpy.typing import ArrayLike

    from turtlewire._native import Buffer, Transform
    from turtlewire.geometry.poses import Pose

    AnyBuffer = TypeVar("AnyBuffer", bound=Buffer)

__all__ = ["bag_report", "equip", "from_bag", "trajectory"]

_FOREVER = (1 << 64) - 1
_REPORTS: weakref.WeakKeyDictionary[Any, Any] = weakref.WeakKeyDictionary()


def equip(buffer_type: Any, transform_type: Any) -> None:
    """Add the methods of this module to a core's two classes."""
    buffer_type.from_bag = classmethod(from_bag)
    buffer_type.bag_report = property(bag_report)
    buffer_type.trajectory = trajectory
    buffer_type.__len__ = _length
    buffer_type.__bool__ = _truth
    buffer_type.__iter__ = _frames
    buffer_type.__contains__ = _contains
    buffer_type.__repr__ = _describe
    buffer_type.__reduce__ = _reduce
    transform_type.__matmul__ = _compose
    transform_type.interpolate = _interpolate


def from_bag(  # noqa: D417 - cls is the class
    cls: type[AnyBuffer],
    path: str | os.PathLike[str],
    *,
    topics: str | Iterable[str] = "/tf",
    static_topics: str | Iterable[str] = "/tf_static",
    start_ns: int = 0,
    end_ns: int = _FOREVER,
    cache_time_ns: int | None = None,
    max_frames: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> AnyBuffer:
    """Return a buffer with all transforms of a bag; `bag_report` tells what was found.

    Args:
        path: A folder of rosbag2, or a ``.mcap`` or ``.db3`` file, compressed or not.
        topics: Where transforms were published, ``"/tf"`` or other names.
        static_topics: Where static transforms were published; they are taken whatever the window.
        start_ns: When the first message to take was received.
        end_ns: When the last message to take was received.
        cache_time_ns: How much history the buffer keeps; None keeps all.
        max_frames: How many frames the buffer takes; None: no limit.
        progress: Called with the share that was read, from 0 to 1; by default a line is drawn on a
            terminal when reading takes more than a second.

    Raises:
        FileNotFoundError: There is nothing at ``path``.
        BagError: It is no bag, none of the topics is in it, or one that is not the default is
            missing or of another type.
        ValueError: The window ends before it begins.
    """
    buffer = cls(cache_time_ns, max_frames)
    _REPORTS[buffer] = import_module("turtlewire.bag.transforms").fill_buffer(
        buffer,
        path,
        topics=topics,
        static_topics=static_topics,
        start_ns=start_ns,
        end_ns=end_ns,
        progress=progress,
    )
    return buffer


def bag_report(self: Buffer) -> Any:
    """Return the `turtlewire.bag.TransformReport` of `from_bag`; None for other buffers."""
    return _REPORTS.get(self)


def trajectory(  # noqa: D417 - self is the buffer
    self: Buffer,
    target_frame: str,
    source_frame: str,
    *,
    stamps: ArrayLike | None = None,
    rate_hz: float | None = None,
    max_gap_ns: int | None = None,
) -> Any:
    """Return the poses of a frame in another over time: a `turtlewire.trajectory.Trajectory`.

    Args:
        target_frame: The frame in which the poses are given.
        source_frame: The frame that moves.
        stamps: The times, int64 nanoseconds or ``datetime64``. Without it and ``rate_hz``: each
            time at which a link on the way has a sample.
        rate_hz: Times at this rate instead.
        max_gap_ns: Longer pauses are gaps, in which no pose lies. See
            `turtlewire.trajectory.sample_trajectory`.

    Raises:
        TransformException: The frames are unknown or not connected.
        ValueError: Nothing moves on the way and no stamps were given.
    """
    sample = import_module("turtlewire.trajectory.sampling").sample_trajectory
    return sample(
        self, target_frame, source_frame, stamps=stamps, rate_hz=rate_hz, max_gap_ns=max_gap_ns
    )


def _length(self: Buffer) -> int:
    """Return the number of frames."""
    return len(self.frame_strings())


def _truth(_self: Buffer) -> bool:
    """Always true: a buffer without frames is a buffer all the same."""
    return True


def _frames(self: Buffer) -> Iterator[str]:
    """Return the names of the frames."""
    return iter(self.frame_strings())


def _contains(self: Buffer, frame: object) -> bool:
    """Return True if the buffer has heard of a frame."""
    return isinstance(frame, str) and self.frame_exists(frame)


def _describe(self: Buffer) -> str:
    from turtlewire.tf.links import links

    known = links(self)
    moving = [link for link in known if not link.static and link.samples]
    text = f"{len(self.frame_strings())} frames, {len(known)} links"
    if moving:
        oldest = min(link.oldest_ns for link in moving)
        newest = max(link.newest_ns for link in moving)
        samples = sum(link.samples for link in moving)
        text += (
            f", {samples:,} samples from {oldest / 1e9:.3f} to {newest / 1e9:.3f} "
            f"({(newest - oldest) / 1e9:.3f} s)"
        )
    return f"<{type(self).__name__}: {text}>"


def _reduce(self: Buffer) -> tuple[Callable[[bytes, Any], Buffer], tuple[bytes, Any]]:
    """Pickles samples, static transforms and `bag_report`, not listeners or a subclass's state."""
    if "__reduce__" not in vars(type(self)):
        raise TypeError(f"cannot pickle {type(self).__name__}, a subclass of turtlewire.Buffer")
    inspection = import_module("turtlewire.tf.inspection")  # which makes buffers, unlike this
    return _restore, (inspection.dumps(self), bag_report(self))


def _restore(data: bytes, report: Any) -> Buffer:
    """Return a pickled buffer."""
    buffer: Buffer = import_module("turtlewire.tf.inspection").loads(data)
    if report is not None:
        _REPORTS[buffer] = report
    return buffer


def _compose(self: Transform, other: Transform) -> Transform:
    """``a_from_b @ b_from_c`` is ``a_from_c``, stamped with the older stamp; 0 is no stamp.

    Raises:
        ValueError: The frames do not meet.
    """
    if not isinstance(other, type(self)):
        if hasattr(other, "__array_ufunc__"):  # NumPy would take the transform for seven numbers
            raise TypeError(
                f"a Transform times {type(other).__name__} is not defined; for points in an array "
                "use as_matrix(), or Buffer.transform_points"
            )
        return NotImplemented
    if self.child_frame_id != other.frame_id:
        raise ValueError(
            f"'{self.frame_id}' from '{self.child_frame_id}' and '{other.frame_id}' from "
            f"'{other.child_frame_id}' do not meet: '{self.child_frame_id}' is not "
            f"'{other.frame_id}'; inverse() turns a transform round"
        )
    stamps = [stamp for stamp in (self.stamp_ns, other.stamp_ns) if stamp]
    pose = canonical(compose(_pose(self), _pose(other)))
    return _made(self, other.child_frame_id, min(stamps, default=0), pose)


def _interpolate(  # noqa: D417 - self is the transform
    self: Transform, other: Transform, stamp_ns: int
) -> Transform:
    """Return the transform at a time between two of the same frames: lerp and slerp, as tf2 does.

    Args:
        other: The transform at another time.
        stamp_ns: A time from one's stamp to the other's, both included.

    Raises:
        ValueError: The frames differ, or the time lies outside.
    """
    names = (self.frame_id, self.child_frame_id), (other.frame_id, other.child_frame_id)
    if names[0] != names[1]:
        raise ValueError(f"transforms of different frames cannot be interpolated: {names}")
    first, last = sorted((self, other), key=lambda each: each.stamp_ns)
    if not first.stamp_ns <= stamp_ns <= last.stamp_ns:
        raise ValueError(f"{stamp_ns} is not between {first.stamp_ns} and {last.stamp_ns}")
    span = last.stamp_ns - first.stamp_ns
    ratio = (stamp_ns - first.stamp_ns) / span if span else 0.0
    pose = canonical(interpolate(_pose(first), _pose(last), ratio))
    return _made(self, self.child_frame_id, stamp_ns, pose)


def _pose(transform: Transform) -> Pose:
    return (*transform.translation, *transform.rotation)


def _made(like: Transform, child: str, stamp_ns: int, pose: Pose) -> Transform:
    make: type[Transform] = type(like)
    return make(like.frame_id, child, stamp_ns, pose[:3], pose[3:])
