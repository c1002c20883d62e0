"""Reads the trajectories of a command line: from a file, a bag's topic or its transforms."""

from __future__ import annotations

import os
import shlex
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer
    from turtlewire.trajectory import Trajectory

#: How much of a bag completion looks at.
_COMPLETION_NS = 10_000_000_000


class TrajectorySource(NamedTuple):
    """A file with a trajectory, or a bag with the names of what moves.

    Attributes:
        path: The file or folder.
        names: Nothing for a file; a topic; or target frame and source frame.
    """

    path: str
    names: tuple[str, ...] = ()

    def __str__(self) -> str:
        return ":".join((self.path, *self.names))

    @property
    def is_transform(self) -> bool:
        """True if it is a chain of transforms, which answers at any time."""
        return len(self.names) == 2


def parse_source(text: str) -> TrajectorySource:
    """``FILE``, ``BAG:/topic`` or ``BAG:target:source``; a path may hold colons itself."""
    parts = text.split(":")
    for count in (0, 1, 2):
        path = ":".join(parts[: len(parts) - count])
        if path and os.path.exists(path):
            return TrajectorySource(path, tuple(parts[len(parts) - count :]))
    return TrajectorySource(text)


@contextmanager
def printed_remarks() -> Iterator[None]:
    """Print warnings about trajectories as lines on standard error."""

    def show(message: Warning | str, *_: object, **__: object) -> None:
        print(f"note: {printable(str(message))}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        warnings.showwarning = show
        yield


class TrajectoryReader:
    """Reads trajectories; a bag whose transforms are wanted twice is read once.

    Args:
        topics: Where the transforms of a bag are.
        static_topics: Where its static transforms are.
        max_gap_ns: Longer pauses are gaps; None: see `Buffer.trajectory`.
    """

    def __init__(
        self,
        topics: str | list[str] = "/tf",
        static_topics: str | list[str] = "/tf_static",
        max_gap_ns: int | None = None,
    ) -> None:
        self._topics = topics
        self._static_topics = static_topics
        self._max_gap_ns = max_gap_ns
        self._buffers: dict[str, Buffer] = {}

    def read(
        self, source: TrajectorySource, like: Trajectory | None = None, rate_hz: float | None = None
    ) -> Trajectory:
        """Return the trajectory.

        Args:
            source: Where it is.
            like: Transforms are looked up at the stamps of this one.
            rate_hz: Transforms are looked up at this rate.

        Raises:
            BagError: The file is not a bag, or has no such topic.
            OSError: The file cannot be read.
            TransformException: The frames are unknown or not connected.
            ValueError: The file is not a trajectory, or nothing moves.
        """
        from turtlewire.trajectory import Trajectory
        from turtlewire.trajectory.sampling import moving_links
        from turtlewire.trajectory.stamps import find_gaps

        if not source.names:
            if _is_bag(source.path):
                raise ValueError(_names_are_missing(source.path))
            found = Trajectory.load(source.path)
            if self._max_gap_ns is None or not found.timed:
                return found
            return replace(found, gaps=tuple(find_gaps(found.stamps_ns, self._max_gap_ns)))
        if not source.is_transform:
            return Trajectory.from_bag(source.path, source.names[0], max_gap_ns=self._max_gap_ns)
        buffer = self._buffer(source.path)
        if like is None and not moving_links(buffer, *source.names):
            raise ValueError(_nothing_moves(source))
        return buffer.trajectory(
            *source.names,
            stamps=None if like is None else like.stamps_ns,
            rate_hz=rate_hz,
            max_gap_ns=self._max_gap_ns,
        )

    def _buffer(self, path: str) -> Buffer:
        from turtlewire.tf.buffer import Buffer

        if path not in self._buffers:
            self._buffers[path] = Buffer.from_bag(
                path, topics=self._topics, static_topics=self._static_topics
            )
        return self._buffers[path]


def _is_bag(path: str) -> bool:
    return os.path.isdir(path) or path.removesuffix(".zstd").endswith((".mcap", ".db3", ".bag"))


def _nothing_moves(source: TrajectorySource) -> str:
    target, moved = source.names
    return (
        f"nothing moves between '{target}' and '{moved}', so there is no path to follow: "
        f"`turtlewire bag tf {shlex.quote(source.path)}` shows which frames have a rate. To look "
        "the pose up at the times of another trajectory, type "
        f"`turtlewire compare OTHER {shlex.quote(str(source))}`"
    )


def _names_are_missing(path: str) -> str:
    from turtlewire.bag import open_bag
    from turtlewire.bag.trajectories import pose_topics

    with open_bag(path) as bag:
        topics = pose_topics(bag)
    has = f"topics with poses: {', '.join(topics)}" if topics else "no topic with poses"
    return (
        f"{path} is a bag: name a topic, or a target and a source frame. It has {has}; "
        f"`turtlewire bag tf {shlex.quote(path)}` shows its frames"
    )


def complete_names(path: str) -> list[str]:
    """Complete names for the shell: a bag's topics with poses, and the frames at its beginning.

    A name with control characters is left out: the shell would act on them.
    """
    from turtlewire.bag import open_bag
    from turtlewire.bag.trajectories import pose_topics
    from turtlewire.errors import BagError
    from turtlewire.tf.buffer import Buffer

    with open_bag(path) as bag:
        names = pose_topics(bag)
        end_ns = bag.start_ns + _COMPLETION_NS
    with suppress(BagError):  # there may be no transforms
        names += Buffer.from_bag(path, end_ns=end_ns, progress=lambda _: None).frames()
    return sorted(name for name in names if name.isprintable())
