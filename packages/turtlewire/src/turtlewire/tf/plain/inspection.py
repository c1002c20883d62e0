"""The methods that show, remove and load samples, and lookups by other rules than tf2's.

The compiled core documents them.
"""

from __future__ import annotations

from itertools import groupby, islice
from typing import TYPE_CHECKING

from turtlewire.tf.plain import arguments
from turtlewire.tf.plain.checks import check_frames, nanoseconds
from turtlewire.tf.plain.failure import Verdict
from turtlewire.tf.plain.transform import Transform

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.links import LinkRow
    from turtlewire.tf.plain.shared_tree import SharedTree


def extrapolate_transform(
    self: SharedTree, target_frame: str, source_frame: str, stamp_ns: int, limit_ns: int
) -> Transform:
    """`lookup_transform`, also for times up to ``limit_ns`` outside of a link's data."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    stamp_ns, limit_ns = nanoseconds(stamp_ns=stamp_ns, limit_ns=limit_ns)
    if limit_ns < 0:
        raise ValueError("limit_ns must not be negative")
    with self._changed:
        pose, _ = self._checked(
            lambda: self._tree.lookup_by(
                target_frame,
                source_frame,
                stamp_ns,
                lambda link: link.read_beyond(stamp_ns, limit_ns),
            )
        )
    return Transform(target_frame, source_frame, stamp_ns, pose[:3], pose[3:])


def lookup_latest(
    self: SharedTree, target_frame: str, source_frame: str, *, max_age_ns: int = 0, now_ns: int = 0
) -> tuple[Transform, dict[str, int]]:
    """The transform made of the newest data of each link, and their stamps by child frame."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    max_age_ns, now_ns = nanoseconds(max_age_ns=max_age_ns, now_ns=now_ns)
    if max_age_ns and not now_ns:
        raise ValueError("max_age_ns needs now_ns, the present by the clock of the stamps")
    with self._changed:
        pose, used = self._checked(
            lambda: self._tree.lookup_by(
                target_frame,
                source_frame,
                now_ns,
                lambda link: link.read_newest(now_ns, max_age_ns),
            )
        )
        stamps = {
            child: link.newest for child in used if not (link := self._tree.links[child]).static
        }
    return Transform(
        target_frame, source_frame, min(stamps.values(), default=0), pose[:3], pose[3:]
    ), stamps


def remove_frame(self: SharedTree, child_frame: str) -> bool:
    """Forget how a frame lies in its parent; whether there was anything to forget."""
    check_frames(child_frame=child_frame)
    with self._changed:
        return bool(self._tree.remove([child_frame]))


def remove_stale(self: SharedTree, before_ns: int) -> list[str]:
    """Remove all frames that move and have no data since a time; their names."""
    (before_ns,) = nanoseconds(before_ns=before_ns)
    with self._changed:
        stale = [
            child
            for child, link in self._tree.links_in_order().items()
            if not link.static and link.newest < before_ns
        ]
        return self._tree.remove(stale)


def stamps(self: SharedTree, child_frame: str) -> NDArray[np.int64]:
    """The times of a frame's samples in nanoseconds, oldest first; none for a static transform."""
    import numpy as np

    check_frames(child_frame=child_frame)
    with self._changed:
        self._checked(lambda: self._tree.check_name(child_frame, "lookupTransform", "target_frame"))
        link = self._tree.links.get(child_frame)
        return np.array([] if link is None or link.fixed else link.stamps, dtype=np.int64)


def samples(
    self: SharedTree, child_frame: str
) -> list[tuple[str, NDArray[np.int64], NDArray[np.float64]]]:
    """Return the whole history of one frame, oldest first.

    For each run of samples with one parent: the parent, the stamps and the poses.
    """
    import numpy as np

    check_frames(child_frame=child_frame)
    with self._changed:
        self._checked(lambda: self._tree.check_name(child_frame, "lookupTransform", "target_frame"))
        link = self._tree.links.get(child_frame)
        if link is None:
            return []
        history = (
            [(0, link.fixed)] if link.fixed else list(zip(link.stamps, link.samples, strict=True))
        )
    return [
        (
            parent,
            np.array([stamp for stamp, _ in rows], dtype=np.int64),
            np.array([sample.pose for _, sample in rows]),
        )
        for parent, run in groupby(history, key=lambda entry: entry[1].parent)
        if (rows := list(run))
    ]


def set_transforms(
    self: SharedTree,
    parent_frame: str,
    child_frame: str,
    stamps: ArrayLike,
    poses: ArrayLike,
    authority: str = "default_authority",
) -> int:
    """set_transform for many samples of one frame; how many were accepted."""
    import numpy as np

    check_frames(parent_frame=parent_frame, child_frame=child_frame, authority=authority)
    times = arguments.stamp_list(stamps)
    rows = np.ascontiguousarray(poses, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 7:
        raise ValueError("poses must have the shape (N, 7)")
    arguments.check_shape(rows, (len(times), 7), "poses")
    accepted = 0
    with self._changed:
        for stamp, row in zip(times, rows.tolist(), strict=True):
            x, y, z, qx, qy, qz, qw = row
            pose = (x, y, z, qx, qy, qz, qw)
            verdict = self._tree.set(
                parent_frame, child_frame, stamp, pose, authority, static=False
            )
            accepted += verdict is Verdict.ACCEPTED
        if accepted:
            self._changed.notify_all()
    if accepted:
        self._call_listeners()
    return accepted


def describe_links(self: SharedTree, most: int) -> list[LinkRow]:
    """For turtlewire.tf.inspection."""
    with self._changed:
        return [
            (
                child,
                link.parent,
                link.static,
                link.length,
                link.oldest,
                link.newest,
                link.parent_changes,
                0,
                link.sender_rows(),
            )
            for child, link in islice(self._tree.links_in_order().items(), most)
        ]


def describe_refusals(self: SharedTree) -> dict[str, tuple[dict[str, int], str]]:
    """For turtlewire.tf.inspection."""
    with self._changed:
        return {
            child: (
                {verdict.value: count for verdict, count in record.counts.items()},
                record.last.explain(),
            )
            for child, record in self._tree.refusals.by_child.items()
        }


def describe_malformed(self: SharedTree) -> tuple[int, str, str]:
    """For turtlewire.tf.inspection."""
    with self._changed:
        return self._tree.refusals.malformed


def rename_sender(self: SharedTree, name: str, shown: str) -> None:
    """Show another name for a sender, also for what it has sent already."""
    with self._changed:
        self._tree.rename_sender(name, shown)


def fault(self: SharedTree) -> str:
    """Return a description of a broken invariant, or an empty string; for tests."""
    with self._changed:
        for child, link in self._tree.links.items():
            if child not in self._tree.frames or (
                link.has_data and link.parent not in self._tree.frames
            ):
                return f"{child}: forgotten, but in use"
            if link.stamps != sorted(link.stamps) or len(link.stamps) != len(link.samples):
                return f"{child}: stamps are not in order"
    return ""
