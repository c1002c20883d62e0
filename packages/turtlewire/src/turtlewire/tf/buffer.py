"""The transform buffer of programs: the chosen core, with what Python adds to it."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from turtlewire.tf.implementation import CORE, BaseBuffer, RecordWalk, Transform

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import ArrayLike
    from typing_extensions import Self

    from turtlewire.bag.transform_report import TransformReport
    from turtlewire.trajectory.trajectory import Trajectory

__all__ = ["CORE", "Buffer", "RecordWalk", "Transform"]

_FOREVER = (1 << 64) - 1


class Buffer(BaseBuffer):
    """The transforms of a tree of frames over time. Safe for use from many threads.

    It is a container of the names of its frames, and true even without any.

    Args:
        cache_time_ns: How long samples are kept, counted back from the newest of their link; None:
            forever.
        max_frames: How many frames it takes; transforms of further ones are refused. None: no
            limit.
    """

    __module__ = "turtlewire"
    __slots__ = ("_bag_report",)

    _bag_report: TransformReport

    # Bags and trajectories lie in rooms above the buffer: their code is imported when it is called.

    @classmethod
    def from_bag(
        cls,
        path: str | os.PathLike[str],
        *,
        topics: str | Iterable[str] = "/tf",
        static_topics: str | Iterable[str] = "/tf_static",
        start_ns: int = 0,
        end_ns: int = _FOREVER,
        cache_time_ns: int | None = None,
        max_frames: int | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Self:
        """Return a buffer with all transforms of a bag; `bag_report` describes what was read.

        Args:
            path: A folder of rosbag2, or a ``.mcap`` or ``.db3`` file, compressed or not.
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
        max_gap_ns: int | None = None,
    ) -> Trajectory:
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
            ValueError: All transforms in the chain are static, and no stamps were given.
        """
        from turtlewire.trajectory.sampling import sample_trajectory

        return sample_trajectory(
            self, target_frame, source_frame, stamps=stamps, rate_hz=rate_hz, max_gap_ns=max_gap_ns
        )

    def __len__(self) -> int:
        return len(self.frame_strings())

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self.frame_strings())

    def __contains__(self, frame: object) -> bool:
        return isinstance(frame, str) and self.frame_exists(frame)

    def __repr__(self) -> str:
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

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle samples, static transforms and `bag_report`, but not listeners."""
        from turtlewire.tf.archive import write

        if type(self) is not Buffer:  # its own state would be lost
            raise TypeError(f"cannot pickle {type(self).__name__}, a subclass of turtlewire.Buffer")
        file = io.BytesIO()
        write(self, file)
        return _restored, (file.getvalue(), self.bag_report)


if CORE == "native":
    from turtlewire._native import bind_hot_methods

    bind_hot_methods(Buffer)


def _restored(data: bytes, report: TransformReport | None) -> Buffer:
    """Return a pickled buffer."""
    from turtlewire.tf.archive import read

    buffer = read(io.BytesIO(data), "the pickled buffer", Buffer)
    if report is not None:
        buffer._bag_report = report
    return buffer
