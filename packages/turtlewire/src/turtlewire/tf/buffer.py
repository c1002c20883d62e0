"""The transform buffer for programs: the chosen core with methods in Python."""

from __future__ import annotations

import errno
import io
import os
import warnings
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from turtlewire.call_errors import hint_at
from turtlewire.terminal.printable import printable
from turtlewire.tf.implementation import CORE, BaseBuffer, RecordWalk, Transform
from turtlewire.wording import Wording, counted, wording

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Self

    from turtlewire.bag.reader import Bag
    from turtlewire.bag.transform_report import TransformReport
    from turtlewire.tf.datetimes import Span, Stamp
    from turtlewire.tf.faults import Problem
    from turtlewire.tf.links import Link
    from turtlewire.trajectory.trajectory import Trajectory


__all__ = ["CORE", "Buffer", "RecordWalk", "Transform"]

hint_at(
    {
        "quaternion quat q orientation": "rotation: x, y, z, w",
        "qx qy qz qw w": "rotation, whose order is x, y, z, w",
        "position t trans": "translation",
        "R rotation_matrix": "as_matrix()[:3, :3]",
        "matrix to_matrix T homogeneous": "as_matrix()",
        "inv inverted": "inverse()",
        "rpy as_euler roll pitch yaw": "euler: roll, pitch, yaw in radians",
        "compose multiply": "`a @ b`",
        "slerp": "interpolate(other, stamp_ns)",
        "transform_points transform_point": "apply(points)",
        "pose": "numpy.array(transform): x, y, z, qx, qy, qz, qw",
        "stamp time timestamp": "stamp_ns",
        "frame_id parent parent_frame header": "target_frame and stamp_ns",
        "child child_frame child_frame_id": "source_frame",
        "transform": "translation and rotation",
    }
)(Transform)


@hint_at(
    {
        "add_transform add set insert": "set_transform",
        "add_static_transform set_transform_static": "set_static_transform",
        "add_transforms insert_transforms": "set_transforms",
        "lookup get get_transform transform query": "lookup_transform",
        "lookup_batch get_transforms": "lookup_transforms",
        "lookup_twist velocity": "lookup_velocity",
        "transform_point": "transform_points",
        "has_frame frame_exists": "`name in buffer`",
        "all_frames get_frames frame_names list_frames": "frames()",
        "all_frames_as_string tree print_tree": "str(buffer)",
        "all_frames_as_yaml": "to_yaml()",
        "get_latest_common_time latest_common_time get_time_range": "time_range(target, source)",
        "wait_for_transform": "lookup_transform with timeout_ns",
        "to_numpy": "samples(child_frame)",
        "plot": "trajectory(target, source).plot(), or turtlewire.show(buffer)",
        "show": "turtlewire.show(buffer)",
    }
)
class Buffer(BaseBuffer):
    """The transforms of a tree of frames over time. Safe for use from many threads.

    ``name in buffer`` is true for the names of its frames, and ``str(buffer)`` draws their tree.

    Args:
        cache_time_ns: How long samples are kept, counted back from the newest of their link; None:
            forever.
        max_frames: How many frames it takes; transforms of further ones are refused. None: no
            limit.
    """

    __module__ = "turtlewire"
    __slots__ = ("_bag_report", "_hint_if_empty", "_wording")

    _bag_report: TransformReport
    _hint_if_empty: str  # set by what fills the buffer, else missing
    _wording: Wording  # set by the interface of programs, else missing

    # Bags and trajectories belong to higher layers: their code is imported when it is called.

    @classmethod
    def from_bag(
        cls,
        path: str | os.PathLike[str] | Bag,
        *,
        topics: str | Iterable[str] = "/tf",
        static_topics: str | Iterable[str] = "/tf_static",
        start_ns: Stamp | None = None,
        end_ns: Stamp | None = None,
        cache_time_ns: Span | None = None,
        max_frames: int | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Self:
        """Return a buffer with all transforms of a bag; `bag_report` describes what was read.

        Args:
            path: A folder of rosbag2, a ``.mcap`` or ``.db3`` file, compressed or not, or an open
                bag.
            topics: Where transforms were published, ``"/tf"`` or other names.
            static_topics: Where static transforms were published; they are taken whatever the
                window.
            start_ns: When the first message to take was received.
            end_ns: When the last message to take was received.
            cache_time_ns: How much history the buffer keeps; None keeps all.
            max_frames: How many frames the buffer takes; None: no limit.
            progress: Called with the share that was read, from 0 to 1; by default a line is drawn
                on a terminal when reading takes more than a second.

        Raises:
            FileNotFoundError: ``path`` does not exist.
            BagError: ``path`` is not a bag, has none of the topics, or a topic other than the
                default is missing or has another type.
            ValueError: The window ends before it begins.

        Warns:
            UserWarning: All transforms of the bag were refused; the text has a reason.
        """
        from turtlewire.bag.transforms import fill_buffer

        buffer = cls(cache_time_ns, max_frames)
        buffer._bag_report = fill_buffer(
            buffer,
            path,
            topics=topics,
            static_topics=static_topics,
            start_ns=start_ns,
            end_ns=end_ns,
            progress=progress,
        )
        if not buffer.frames() and (refused := buffer._what_was_refused()):
            name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else path.path
            warnings.warn(f"{name}: {refused}", stacklevel=2)
        return buffer

    @property
    def bag_report(self) -> TransformReport | None:
        """The `turtlewire.bag.TransformReport` of `from_bag`; None for other buffers."""
        return getattr(self, "_bag_report", None)

    def trajectory(
        self,
        target_frame: str,
        source_frame: str,
        *,
        stamps: ArrayLike | None = None,
        rate_hz: float | None = None,
        max_gap_ns: Span | None = None,
    ) -> Trajectory:
        """Return the poses of a frame in another over time: a `turtlewire.trajectory.Trajectory`.

        Args:
            target_frame: The frame in which the poses are given.
            source_frame: The frame that moves.
            stamps: The times, int64 nanoseconds or ``datetime64``. Without it and ``rate_hz``: each
                time at which a link on the way has a sample.
            rate_hz: Times at this rate instead.
            max_gap_ns: Longer pauses between samples are gaps, in which no pose lies. None takes
                ten times the median pause of the link, and at least half a second.

        Raises:
            TransformException: The frames are unknown or not connected.
            ValueError: All transforms in the chain are static, and no stamps were given; or both
                stamps and a rate were given.
        """
        from turtlewire.trajectory.sampling import sample_trajectory

        return sample_trajectory(
            self, target_frame, source_frame, stamps=stamps, rate_hz=rate_hz, max_gap_ns=max_gap_ns
        )

    def links(self) -> list[Link]:
        """Return the links, in the order in which their frames first arrived."""
        from turtlewire.tf.links import links

        return links(self)

    def problems(self) -> list[Problem]:
        """Return contradictions, refused transforms and malformed messages.

        Contradictions are frames with two senders or two parents, and loops of frames. A tree in
        which parent and child of one transform are swapped does not contradict itself.
        """
        from turtlewire.tf.faults import problems

        return problems(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all samples and static transforms to a file.

        The format is NumPy's ``.npz``, without pickled objects, whatever the name of the file.

        Raises:
            ValueError: The name ends in the suffix of another format, for example ``.csv``.
        """
        from turtlewire.new_file import new_file
        from turtlewire.tf.archive import check_name, write

        check_name(path)
        with new_file(path) as unfinished, open(unfinished, "wb") as file:
            write(self, file)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Return a new buffer with what `save` wrote.

        Memory and time stay in proportion to the size of the file, whatever it contains.

        Raises:
            FileNotFoundError: Nothing is at ``path``.
            IsADirectoryError: ``path`` is a folder, for example a bag.
            TypeError: ``path`` is not a path.
            ValueError: The file is something else, or damaged.
        """
        from turtlewire.path_arguments import missing_file
        from turtlewire.tf.archive import read

        if not isinstance(path, (str, bytes, os.PathLike)):  # an int would be a file descriptor
            given = type(path).__name__
            raise TypeError(f"Buffer.load accepts the path of what Buffer.save wrote, not {given}")
        if os.path.isdir(path):
            text = "a saved buffer is a file; to read a bag, call Buffer.from_bag"
            raise IsADirectoryError(errno.EISDIR, text, os.fspath(path))
        if not os.path.exists(path):
            raise missing_file(os.fsdecode(path))
        with open(path, "rb") as file:
            return read(file, os.fspath(path), cls)

    def _why_empty(self) -> str:
        """Return the hint of a lookup in this buffer while it has no frames."""
        refused = self._what_was_refused()
        return refused or getattr(self, "_hint_if_empty", "No transform was set yet.")

    def _what_was_refused(self) -> str:
        """Return how many transforms and messages were refused, with a reason; may be empty."""
        found = [each for each in self.problems() if each.kind in {"refused", "malformed"}]
        if not found:
            return ""
        count = sum(each.count for each in found)
        return (
            f"Refused transforms and malformed messages: {count:,}; for example, "
            f"{printable(found[0].text).rstrip('.')}. {wording(self).problems} lists them."
        )

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self._knows(frame)

    def __str__(self) -> str:
        from turtlewire.tf.links import text_tree

        return text_tree(self)

    def __repr__(self) -> str:
        known = self.links()
        moving = [link for link in known if not link.static and link.samples]
        text = f"{counted(len(self.frames()), 'frame')}, {counted(len(known), 'link')}"
        if moving:
            oldest = min(link.oldest_ns for link in moving)
            newest = max(link.newest_ns for link in moving)
            samples = sum(link.samples for link in moving)
            text += (
                f", {counted(samples, 'sample')} from {oldest / 1e9:.3f} to {newest / 1e9:.3f} "
                f"({(newest - oldest) / 1e9:.3f} s)"
            )
        return f"<{type(self).__name__}: {text}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle samples, static transforms and `bag_report`, but not listeners."""
        from turtlewire.tf.archive import write

        if type(self) is not Buffer:  # its own state would be lost
            raise TypeError(f"cannot pickle {type(self).__name__}, a subclass of turtlewire.Buffer")
        file = io.BytesIO()
        write(self, file)
        return _restored, (file.getvalue(), self.bag_report)


if CORE == "native":
    from turtlewire._native import bind_methods

    bind_methods(Buffer)


def _restored(data: bytes, report: TransformReport | None) -> Buffer:
    """Return a pickled buffer."""
    from turtlewire.tf.archive import read

    buffer = read(io.BytesIO(data), "the pickled buffer", Buffer)
    if report is not None:
        buffer._bag_report = report
    return buffer
