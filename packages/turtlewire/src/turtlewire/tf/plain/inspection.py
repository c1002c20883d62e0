"""The methods that show, remove and load samples, and lookups by other rules than tf2's.

The compiled core documents them.
"""

from __future__ import annotations

from itertools import groupby, islice
from typing import TYPE_CHECKING, Literal

from turtlewire.tf.answers import Samples
from turtlewire.tf.plain import checks
from turtlewire.tf.plain.checks import check_frames, moments, nanoseconds
from turtlewire.tf.plain.failure import Refusal, Verdict
from turtlewire.tf.plain.transform import Transform

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.geometry.poses import Pose
    from turtlewire.tf.links import LinkRow
    from turtlewire.tf.plain.shared_tree import SharedTree
    from turtlewire.tf.plain.tree import Tree


def lookup_newest(
    self: SharedTree,
    target_frame: str,
    source_frame: str,
    *,
    max_age_ns: int | None = None,
    now_ns: int | None = None,
) -> Transform:
    """The transform made of the newest data of each link, with the oldest of their stamps."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    max_age, now = moments(max_age_ns=max_age_ns, now_ns=now_ns)
    oldest = None
    if max_age is not None:
        if now is None:
            raise ValueError("max_age_ns needs now_ns, the present by the clock of the stamps")
        if max_age < 0:
            raise ValueError("max_age_ns must not be negative")
        oldest = now - max_age
    with self._lock:
        pose, used = self._checked(
            lambda: self._tree.lookup_by(
                target_frame, source_frame, now, lambda link: link.read_newest(oldest)
            )
        )
        stamps = [self._tree.links[child].reached for child in used]
    stamp = min((stamp for stamp in stamps if stamp is not None), default=None)
    return Transform(target_frame, source_frame, pose[:3], pose[3:], stamp_ns=stamp)


def time_range(self: SharedTree, target_frame: str, source_frame: str) -> tuple[int, int] | None:
    """The oldest and the newest time at which lookups answer; None if they always do."""
    check_frames(target_frame=target_frame, source_frame=source_frame)
    with self._lock:
        newest, used = self._checked(lambda: _links_between(self._tree, target_frame, source_frame))
        links = [self._tree.links[child] for child in used]
    oldest = [link.oldest for link in links if not link.static]
    return None if newest is None or not oldest else (max(oldest), newest)


def _links_between(tree: Tree, target: str, source: str) -> tuple[int | None, list[str]]:
    """Return the latest common time, and the children of the links between two frames then."""
    tree.check_name(target, "lookupTransform", "target_frame")
    tree.check_name(source, "lookupTransform", "source_frame")
    if target == source:
        return None, []
    newest = tree.latest_common_time(target, source)
    return newest, tree.lookup_by(target, source, newest, lambda link: link.read(newest))[1]


def remove_frame(self: SharedTree, child_frame: str) -> bool:
    """Forget how a frame lies in its parent; whether there was anything to forget."""
    check_frames(child_frame=child_frame)
    with self._lock:
        return bool(self._tree.remove([child_frame]))


def remove_stale(self: SharedTree, before_ns: int) -> list[str]:
    """Remove all frames that move and have no data since a time; their names."""
    (before_ns,) = nanoseconds(before_ns=before_ns)
    with self._lock:
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
    with self._lock:
        self._checked(lambda: self._tree.check_name(child_frame, "lookupTransform", "target_frame"))
        link = self._tree.links.get(child_frame)
        return np.array([] if link is None or link.fixed else link.stamps, dtype=np.int64)


def samples(self: SharedTree, child_frame: str) -> list[Samples]:
    """Return the whole history of one frame, oldest first.

    For each run of samples with one parent: the parent, the stamps and the poses.
    """
    import numpy as np

    check_frames(child_frame=child_frame)
    with self._lock:
        self._checked(lambda: self._tree.check_name(child_frame, "lookupTransform", "target_frame"))
        link = self._tree.links.get(child_frame)
        if link is None:
            return []
        history = (
            [(0, link.fixed)] if link.fixed else list(zip(link.stamps, link.samples, strict=True))
        )
    return [
        Samples(
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
    *,
    errors: Literal["raise", "skip"] = "raise",
    sender: str = "default_authority",
) -> int:
    """Add many samples of one frame; returns how many the buffer now holds."""
    from turtlewire.tf.pose_rows import pose_rows

    check_frames(parent_frame=parent_frame, child_frame=child_frame, sender=sender)
    skip = checks.check_errors(errors, "skip")
    times = checks.stamp_list(stamps)
    rows = pose_rows(poses, skip=skip)
    checks.check_shape(rows, (len(times), 7), "poses")
    samples: list[tuple[int, Pose]] = [
        (stamp, (x, y, z, qx, qy, qz, qw))
        for stamp, (x, y, z, qx, qy, qz, qw) in zip(times, rows.tolist(), strict=True)
    ]
    with self._lock:
        if errors == "raise":
            _check_batch(self._tree, parent_frame, child_frame, samples, sender)
        accepted = [
            stamp
            for stamp, pose in samples
            if self._tree.set(parent_frame, child_frame, stamp, pose, sender, static=False)
            is Verdict.ACCEPTED
        ]
        if accepted:
            oldest = self._tree.links[child_frame.removeprefix("/")].oldest
            self._end_waits()
    if not accepted:
        return 0
    self._call_listeners()
    return sum(stamp >= oldest for stamp in accepted)


def _check_batch(
    tree: Tree, parent: str, child: str, samples: list[tuple[int, Pose]], sender: str
) -> None:
    """Raise for the first sample that the buffer would not hold when all are added."""
    parent, child = parent.removeprefix("/"), child.removeprefix("/")
    link = tree.links.get(child)
    newest = [link.newest] if link and link.stamps else []
    limit = max([*newest, *(stamp for stamp, _ in samples)], default=0) - tree.keep
    for row, (stamp, pose) in enumerate(samples):
        verdict = tree.judge(parent, child, pose)
        if verdict is Verdict.ACCEPTED and stamp < limit:
            verdict = Verdict.OLD_DATA
        if verdict is not Verdict.ACCEPTED:
            refusal = Refusal(verdict, parent, child, stamp, pose, sender)
            tree.refusals.add(refusal)
            refusal.check(row)


def describe_links(self: SharedTree, most: int) -> list[LinkRow]:
    """For `turtlewire.tf.links` and `turtlewire.tf.faults`."""
    with self._lock:
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
    """For `turtlewire.tf.links` and `turtlewire.tf.faults`."""
    with self._lock:
        refusals = self._tree.refusals
        return {
            child: (
                {verdict.value: count for verdict, count in counts.items()},
                refusals.last[child].explain(),
            )
            for child, counts in refusals.counts.items()
        }


def refusal_kinds(self: SharedTree) -> int:
    """Return how many pairs of a frame and a reason were refused, without the lack of room."""
    with self._lock:
        return self._tree.refusals.kinds


def describe_malformed(self: SharedTree) -> tuple[int, str, str]:
    """For `turtlewire.tf.links` and `turtlewire.tf.faults`."""
    with self._lock:
        return self._tree.refusals.malformed


def rename_sender(self: SharedTree, name: str, shown: str) -> None:
    """Show another name for a sender, also for what it has sent already."""
    with self._lock:
        self._tree.rename_sender(name, shown)


def fault(self: SharedTree) -> str:
    """Return a description of a broken invariant, or an empty string; for tests."""
    with self._lock:
        for child, link in self._tree.links.items():
            if child not in self._tree.frames or (
                link.has_data and link.parent not in self._tree.frames
            ):
                return f"{child}: forgotten, but in use"
            if link.stamps != sorted(link.stamps) or len(link.stamps) != len(link.samples):
                return f"{child}: stamps are not in order"
    return ""
