"""The poses of all frames in one frame, at one time, as one array, for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire.errors import TransformException
from turtlewire.tf.frame_tree import FrameTree, read_frame_tree

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.tf.buffer import Buffer
    from turtlewire_view.displays.content import Content

__all__ = [
    "FRAME_TIMEOUT_S",
    "Base",
    "FrameScene",
    "Frames",
    "TreeStructure",
]


class Base:
    """The reference of poses: a frame, the origin subtracted from its coordinates, and a buffer.

    With ``own_frames``, each message is shown in its own frame, because there are no transforms.
    """

    __slots__ = ("buffer", "fixed", "origin", "own_frames")

    def __init__(
        self,
        buffer: Buffer,
        fixed: str,
        origin: tuple[float, float, float],
        *,
        own_frames: bool = False,
    ) -> None:
        self.buffer = buffer
        self.fixed = fixed
        self.origin = origin
        self.own_frames = own_frames

    def same_place(self, other: Base) -> bool:
        """Return True if poses in both are equal."""
        return (self.fixed, self.origin, self.own_frames) == (
            other.fixed,
            other.origin,
            other.own_frames,
        )

    def arrays(self, content: Content) -> dict[str, NDArray[Any]]:
        """Return the arrays of a content, with those that depend on where it is.

        Raises:
            TransformException: A transform that they need is not known.
        """
        if content.placed is None or content.frame_id is None:
            return content.arrays
        stamps = np.array([content.stamp_ns], dtype=np.int64)
        if content.placed.stamps_ns is not None:
            stamps = np.concatenate([stamps, content.placed.stamps_ns])
        if self.own_frames:
            matrices = np.tile(np.eye(4), (len(stamps), 1, 1))
            return {**content.arrays, **content.placed.arrays(matrices)}
        if not stamps.all():  # a message with the stamp 0 is drawn at the latest time
            newest = self.buffer.lookup_transform(self.fixed, content.frame_id).stamp_ns
            stamps = np.where(stamps == 0, newest or 0, stamps)
        matrices = self.buffer.lookup_transforms(
            self.fixed, content.frame_id, stamps, matrices=True
        )
        if not np.isfinite(matrices).all():
            raise TransformException(f"A pose of {content.frame_id!r} is not finite.")
        return {**content.arrays, **content.placed.arrays(matrices)}

    def pose(self, content: Content) -> list[float]:
        """Return the pose of a content's anchor: x, y, z, and the quaternion xyzw.

        Raises:
            TransformException: The pose is unknown.
        """
        assert content.frame_id is not None
        if self.own_frames:
            return [*np.subtract(content.anchor, self.origin).tolist(), 0.0, 0.0, 0.0, 1.0]
        fixed_from_frame = self.buffer.lookup_transform(
            self.fixed, content.frame_id, content.stamp_ns or None
        )
        matrix = fixed_from_frame.as_matrix()
        place = matrix[:3, :3] @ np.asarray(content.anchor) + matrix[:3, 3] - self.origin
        pose = [*place.tolist(), *fixed_from_frame.rotation]
        if not np.isfinite(pose).all():
            raise TransformException(f"The pose of {content.frame_id!r} is not finite.")
        return pose


#: Beyond this distance from the origin [m], 32-bit coordinates would be wrong by a millimetre.
_FAR_M = 10_000.0
_ORIGIN_STEP_M = 1_000.0
#: A frame that is farther away than the sun is a mistake, and cannot be drawn.
_FARTHEST_M = 1.5e11
#: How long RViz shows a frame that gets no newer data [s].
FRAME_TIMEOUT_S = 15.0


class TreeStructure(NamedTuple):
    """The frames and their parents; they change rarely.

    Attributes:
        version: Counts changes.
        names: The N frames, parents before children.
        parents: For each frame the index of its parent, or -1.
        trees: For each frame the index of its root in ``roots``.
        roots: The root of each tree, the largest tree first.
        loops: Frames that are their own ancestors, from child to parent.
    """

    version: int
    names: list[str]
    parents: list[int]
    trees: list[int]
    roots: list[str]
    loops: list[list[str]]


class Frames(NamedTuple):
    """The poses at one time.

    Attributes:
        structure: The frames.
        fixed: The frame in which poses of its tree are given; poses of other trees are given in
            their roots.
        origin: What was subtracted from the positions in the fixed frame's tree [m].
        poses: (N, 7) x, y, z, and the quaternion xyzw, 32-bit.
        stamps: (N,) newest time that a frame has in common with the fixed frame [s]; 0 if all
            between them is static.
        known: (N,) 1 for each frame that has a finite pose at that time.
    """

    structure: TreeStructure
    fixed: str
    origin: tuple[float, float, float]
    poses: NDArray[np.float32]
    stamps: NDArray[np.float64]
    known: NDArray[np.uint8]

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return a packet's arrays."""
        return {"poses": self.poses, "stamps": self.stamps, "known": self.known}


#: The time of poses that always hold.
_NO_TIME = np.iinfo(np.int64).min


class _Rows(NamedTuple):
    """A row for each frame of the structure, to be filled."""

    poses: NDArray[np.float64]
    stamps: NDArray[np.float64]
    known: NDArray[np.uint8]


def _no_rows(count: int) -> _Rows:
    return _Rows(np.zeros((count, 7)), np.zeros(count), np.zeros(count, np.uint8))


class FrameScene:
    """Computes frames for one page. Not thread-safe."""

    def __init__(self) -> None:
        self._structure = TreeStructure(0, [], [], [], [], [])
        self._index: dict[str, int] = {}
        self._names_seen: list[str] = []
        self._rows: dict[str, tuple[list[str], NDArray[np.intp]]] = {}
        self._origin = (0.0, 0.0, 0.0)

    @property
    def structure(self) -> TreeStructure:
        """The frames of the last look."""
        return self._structure

    def look(self, buffer: Buffer, fixed: str = "", stamp_ns: int | None = None) -> Frames:
        """Compute all poses.

        Args:
            buffer: The frames.
            fixed: The frame to look from; empty, or one that does not exist, takes the root of the
                largest tree.
            stamp_ns: None uses the newest time that each frame has in common with the fixed one. A
                frame whose data end before the stamp stays where it was for as long as RViz shows
                it.
        """
        names = buffer.frames()
        if names != self._names_seen:
            self.read_structure(buffer)
            self._names_seen = names
        structure = self._structure
        is_there = fixed in self._index
        tree = structure.trees[self._index[fixed]] if is_there else 0
        shown = fixed if is_there else (structure.roots or [""])[0]
        rows = _no_rows(len(structure.names))
        poses, stamps, known = rows
        for number, root in enumerate(structure.roots):
            target = shown if number == tree else root
            self._fill(rows, buffer, target, stamp_ns)
            if stamp_ns is not None and not known[np.asarray(structure.trees) == number].all():
                self._fill_last_seen(rows, buffer, target, stamp_ns)
        with np.errstate(invalid="ignore"):
            known &= (np.abs(poses) < _FARTHEST_M).all(axis=1)
        poses[known == 0] = 0.0
        self._subtract_origin(poses, (np.asarray(structure.trees) == tree) & (known == 1))
        return Frames(structure, shown, self._origin, poses.astype(np.float32), stamps, known)

    def read_structure(self, buffer: Buffer) -> None:
        """Look which frames there are, and who is whose parent: that may change without new names.

        It is as expensive as forty looks at the poses, so a page does it once a second.
        """
        tree = read_frame_tree(buffer)
        names, trees, roots = _in_order(tree)
        index = {name: number for number, name in enumerate(names)}
        cut = set(tree.roots)
        parents = [
            -1 if name in cut or name not in tree.links else index[tree.links[name].parent]
            for name in names
        ]
        former = self._structure
        if (names, parents, roots, tree.loops) != (
            former.names,
            former.parents,
            former.roots,
            former.loops,
        ):
            self._structure = TreeStructure(
                former.version + 1, names, parents, trees, roots, tree.loops
            )
            self._index = index
            self._rows.clear()

    def _fill(self, out: _Rows, buffer: Buffer, target: str, stamp_ns: int | None) -> None:
        """Look up all frames in ``target``, and put them in the rows of the structure."""
        try:
            names, found, times_ns = buffer.lookup_all(target, stamp_ns)
        except TransformException:
            return  # until now, the frame was only a name
        former, rows = self._rows.get(target, (None, None))
        if rows is None or names != former:
            rows = np.array([self._index.get(name, -1) for name in names], np.intp)
            self._rows[target] = (names, rows)
        there = rows >= 0  # a frame may have come since the structure was read
        times_ns[times_ns == _NO_TIME] = 0
        out.poses[rows[there]], out.stamps[rows[there]] = found[there], times_ns[there] / 1e9
        out.known[rows[there]] = 1

    def _fill_last_seen(self, out: _Rows, buffer: Buffer, target: str, stamp_ns: int) -> None:
        """Put frames whose newest data are a little older than the stamp where they were then."""
        last = _no_rows(len(out.known))
        self._fill(last, buffer, target, None)
        age = stamp_ns / 1e9 - last.stamps
        rows = (out.known == 0) & (last.known == 1) & (age >= 0) & (age <= FRAME_TIMEOUT_S)
        out.poses[rows], out.stamps[rows], out.known[rows] = last.poses[rows], last.stamps[rows], 1

    def _subtract_origin(self, poses: NDArray[np.float64], rows: NDArray[np.bool_]) -> None:
        """Keep coordinates small enough for 32 bits; the origin moves only when it must."""
        places = poses[rows, :3]
        if places.size:
            centre = np.median(places, axis=0)
            if np.abs(centre - self._origin).max() > _FAR_M:
                step = _ORIGIN_STEP_M
                x, y, z = (float(value) for value in np.round(centre / step) * step)
                self._origin = (x, y, z)
            elif np.abs(centre).max() <= _FAR_M / 2:
                self._origin = (0.0, 0.0, 0.0)
        poses[rows, :3] -= self._origin


def _in_order(tree: FrameTree) -> tuple[list[str], list[int], list[str]]:
    """The frames parents first, the number of the tree of each, and the roots by size of trees."""
    found = []
    for root in tree.roots:
        members, waiting = [], [root]
        while waiting:
            frame = waiting.pop()
            members.append(frame)
            waiting += reversed(tree.children[frame])
        found.append((root, members))
    found.sort(key=lambda each: -len(each[1]))  # stable, so the first of equal ones stays first
    names = [name for _, members in found for name in members]
    trees = [number for number, (_, members) in enumerate(found) for _ in members]
    return names, trees, [root for root, _ in found]
