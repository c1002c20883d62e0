"""The tree of frames, and tf2's search in it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, TypeAlias

from turtlewire.geometry.poses import IDENTITY, Pose
from turtlewire.tf.plain.failure import (
    Failure,
    Question,
    Refusal,
    Verdict,
    connection_failure,
    loop_failure,
    name_failure,
    time_failure,
)
from turtlewire.tf.plain.link import LinkSamples, PoseSample, is_nan
from turtlewire.tf.plain.refusals import Refusals
from turtlewire.tf.plain.report import frames_as_string
from turtlewire.tf.plain.rules import ENGINE
from turtlewire.tf.plain.status import LookupStatus

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Quaternion

MAX_GRAPH_DEPTH = 1000
"""tf2 takes more hops for a loop."""

NO_PARENT = "NO_PARENT"

Reader: TypeAlias = "Callable[[LinkSamples], PoseSample | LookupStatus]"
_LONGEST_NAME = 4096
#: Of a quaternion's squared length, in tf2.
_LENGTH_TOLERANCE = 10e-3


class Tree:
    """All links by their child frame. Not locked.

    Args:
        keep: How long samples are kept, in nanoseconds.
        max_frames: Samples of further frames are refused; None: no limit.
    """

    def __init__(self, keep: int, max_frames: int | None = None) -> None:
        self.keep = keep
        self.max_frames = max_frames
        self.is_full = False
        self.rules = ENGINE
        self.frames: dict[str, None] = {}  # a set in order of arrival
        self.links: dict[str, LinkSamples] = {}
        self.refusals = Refusals()
        self.shown_senders: dict[str, str] = {}

    def set(
        self, parent: str, child: str, stamp: int, pose: Pose, authority: str, *, static: bool
    ) -> Verdict:
        """Add a sample."""
        parent, child = parent.removeprefix("/"), child.removeprefix("/")
        authority = self.shown_senders.get(authority, authority)
        verdict = self._insert(parent, child, stamp, pose, static=static)
        if verdict is Verdict.ACCEPTED:
            self.links[child].count_sender(authority, parent, stamp)
        else:
            self.refusals.add(Refusal(verdict, parent, child, stamp, pose, authority))
        return verdict

    def _insert(self, parent: str, child: str, stamp: int, pose: Pose, *, static: bool) -> Verdict:
        verdict = self.judge(parent, child, pose)
        if verdict is not Verdict.ACCEPTED:
            self.is_full = self.is_full or verdict is Verdict.TOO_MANY_FRAMES
            return verdict
        stored = self.rules.stored(pose)
        self.frames.setdefault(child)
        self.frames.setdefault(parent)
        link = self.links.get(child)
        if link is None or link.static != static:
            known = link
            link = LinkSamples(static=static, rules=self.rules)
            if known is not None:
                link.senders = known.senders
            self.links[child] = link
        fits = link.insert(stamp, PoseSample(parent, stored), self.keep)
        return Verdict.ACCEPTED if fits else Verdict.OLD_DATA

    def judge(self, parent: str, child: str, pose: Pose) -> Verdict:
        """Return what `set` would say of a sample, but for its time."""
        verdict = judge_names(parent, child)
        if verdict is not Verdict.ACCEPTED:
            return verdict
        stored = self.rules.stored(pose)
        if is_nan(stored):
            return Verdict.NAN_VALUE
        if self.rules.keeps_rotations and not _is_nearly_unit(stored[3:]):
            return Verdict.DENORMALIZED
        return Verdict.ACCEPTED if self._has_room(child, parent) else Verdict.TOO_MANY_FRAMES

    def _has_room(self, *names: str) -> bool:
        if self.max_frames is None:
            return True
        new = sum(name not in self.frames for name in names)
        return not new or len(self.frames) + new <= self.max_frames

    def rename_sender(self, name: str, shown: str) -> None:
        """Show another name for a sender, now and later."""
        self.shown_senders[name] = shown
        self.refusals.rename_sender(name, shown)
        for link in self.links.values():
            link.rename_sender(name, shown)

    def remove(self, children: Iterable[str]) -> list[str]:
        """Forget links, and names that are then unused; returns the children that had a link."""
        removed = {child: link for child in children if (link := self.links.pop(child, None))}
        if removed:
            self.is_full = False
        in_use = {parent for link in self.links.values() for parent in link.parents}
        for child, link in removed.items():
            for frame in (child, *link.parents):
                if frame not in in_use and frame not in self.links:
                    self.frames.pop(frame, None)
        return list(removed)

    def links_in_order(self) -> dict[str, LinkSamples]:
        """Return the links by child, in the order in which the frames were first named."""
        return {frame: self.links[frame] for frame in self.frames if frame in self.links}

    def clear(self) -> None:
        """Forget all samples; names stay, and static poses by most rules."""
        for link in self.links.values():
            link.clear(static_stays=not self.rules.clears_static)

    def check_name(self, name: str, question: Question, argument: str) -> None:
        """Raise Failure unless the frame can be asked for."""
        status = LookupStatus.OK
        if not name:
            status = LookupStatus.EMPTY_NAME
        elif name.startswith("/"):
            status = LookupStatus.SLASH_NAME
        elif name not in self.frames:
            status = LookupStatus.UNKNOWN_FRAME
        if status:
            raise name_failure(status, name, question, argument)

    def lookup(
        self, target: str, source: str, stamp: int | None, question: Question, beyond: int = 0
    ) -> tuple[int | None, Pose]:
        """Return the time and the pose ``target_from_source``.

        A frame in itself is the identity, also for a frame that does not exist, as in tf2.

        Args:
            target: The frame in which the answer is expressed.
            source: The frame whose pose is requested.
            stamp: The time; None requests the latest common time. A result without a time is
                static.
            question: The method that asks; tf2's reasons depend on it.
            beyond: How far outside of a link's data its motion is extrapolated; tf2 never does
                this.
        """
        if target == source:
            link = self.links.get(target)
            return (link.reached if stamp is None and link else stamp, IDENTITY)
        self.check_name(target, question, "target_frame")
        self.check_name(source, question, "source_frame")
        latest = stamp is None
        if latest:
            stamp = self.latest_common_time(target, source)
        try:
            return stamp, self.rules.stored(self._pose(target, source, stamp, beyond))
        except Failure as failure:
            failure.hopeless = failure.hopeless and not latest  # new data moves the latest time on
            raise

    def _pose(self, target: str, source: str, stamp: int | None, beyond: int) -> Pose:
        try:
            return self._walk(target, source, stamp, lambda link: link.read(stamp))[0]
        except Failure:
            if not beyond:
                raise
        return self._walk(target, source, stamp, lambda link: link.read_beyond(stamp, beyond))[0]

    def lookup_by(
        self, target: str, source: str, stamp: int | None, read: Reader
    ) -> tuple[Pose, list[str]]:
        """The pose when links answer by ``read``, not by tf2's rule; and the links' children."""
        self.check_name(target, "lookupTransform", "target_frame")
        self.check_name(source, "lookupTransform", "source_frame")
        if target == source:
            return IDENTITY, []
        pose, used = self._walk(target, source, stamp, read)
        return self.rules.stored(pose), used

    def _walk(
        self, target: str, source: str, stamp: int | None, read: Reader
    ) -> tuple[Pose, list[str]]:
        """Walk from the source to the root, then from the target up to that walk.

        A link without data ends the first walk and fails the second. If both walks have no data,
        the failure of the link with the newer data is raised, as tf2 has done since 0.36.20.
        """
        up: list[str] = []
        down: list[str] = []
        source_to_top, stopped, reached = IDENTITY, None, 0
        top = source
        for depth in range(MAX_GRAPH_DEPTH + 2):
            link = self.links.get(top)
            if link is None:
                break
            reading = read(link)
            if isinstance(reading, LookupStatus):
                # Not raised yet: the target's chain may join the source's chain below this link.
                stopped = self._time_failure(reading, top, link, stamp, target, source)
                reached = link.newest
                break
            if top == target:
                return source_to_top, up
            up.append(top)
            source_to_top = self.rules.compose(reading.pose, source_to_top)
            top = reading.parent
            self._check_depth(depth + 1)
        target_to_top, frame = IDENTITY, target
        for depth in range(MAX_GRAPH_DEPTH + 2):
            link = self.links.get(frame)
            if frame == top:
                return self.rules.between(target_to_top, source_to_top), [
                    f for f in up + down if (f in up) != (f in down)
                ]
            if link is None:
                break
            reading = read(link)
            if isinstance(reading, LookupStatus):
                if stopped is not None and reached >= link.newest:
                    raise stopped
                raise self._time_failure(reading, frame, link, stamp, target, source)
            if frame == source:
                return self.rules.between(target_to_top, IDENTITY), down
            down.append(frame)
            target_to_top = self.rules.compose(reading.pose, target_to_top)
            frame = reading.parent
            self._check_depth(depth + 1)
        raise stopped or self._connection_failure(target, source)

    def _time_failure(
        self,
        reading: LookupStatus,
        child: str,
        link: LinkSamples,
        stamp: int | None,
        target: str,
        source: str,
    ) -> Failure:
        told = self.rules.tells_emptied
        return time_failure(
            reading, child, link, stamp, target, source, self.keep, tells_emptied=told
        )

    def _connection_failure(self, target: str, source: str) -> Failure:
        return connection_failure(target, source, self._root(target), self._root(source))

    def _root(self, frame: str) -> str:
        for _ in range(MAX_GRAPH_DEPTH):
            link = self.links.get(frame)
            if link is None or not link.has_data:
                break
            frame = link.parent
        return frame

    def _check_depth(self, depth: int) -> None:
        if depth > MAX_GRAPH_DEPTH:
            raise loop_failure(frames_as_string(self.links_in_order()))

    def latest_common_time(self, target: str, source: str) -> int | None:
        """Return the oldest of the links' newest stamps between the frames; None if all are static.

        The newest parent of each link counts.
        """
        if target == source:
            link = self.links.get(source)
            return link.reached if link else None
        #: Each ancestor of the source, with the number of stamps on the way to it.
        line: dict[str, int] = {}
        stamps: list[int | None] = []
        frame = source
        while (link := self.links.get(frame)) and link.last_parent:
            stamps.append(link.reached)
            frame = link.last_parent
            line.setdefault(frame, len(stamps))
            if frame == target:
                return self._earliest(stamps)
            self._check_depth(len(stamps))
        target_stamps: list[int | None] = []
        frame = target
        while (link := self.links.get(frame)) and link.last_parent:
            target_stamps.append(link.reached)
            frame = link.last_parent
            if frame in line:
                return self._earliest(target_stamps + stamps[: line[frame]])
            if frame == source:
                return self._earliest(target_stamps)
            self._check_depth(len(target_stamps))
        raise self._connection_failure(target, source)

    def _earliest(self, stamps: list[int | None]) -> int | None:
        return min(
            (stamp for stamp in stamps if stamp is not None and stamp != self.rules.no_time),
            default=None,
        )


def _is_nearly_unit(q: Quaternion) -> bool:
    return abs(sum(number * number for number in q) - 1.0) < _LENGTH_TOLERANCE


def _is_frame_name(name: str) -> bool:
    try:
        return "\0" not in name and len(name.encode()) <= _LONGEST_NAME
    except UnicodeEncodeError:
        return False


def judge_names(parent: str, child: str) -> Verdict:
    """Judge the names of a transform; invalid UTF-8 is in them as surrogates."""
    if child == parent:
        return Verdict.SELF_TRANSFORM
    if not child:
        return Verdict.NO_CHILD_FRAME
    if not parent:
        return Verdict.NO_PARENT_FRAME
    if NO_PARENT in {child, parent}:
        return Verdict.RESERVED_NAME
    if not (_is_frame_name(child) and _is_frame_name(parent)):
        return Verdict.BAD_NAME
    return Verdict.ACCEPTED


__all__ = ["MAX_GRAPH_DEPTH", "NO_PARENT", "Failure", "Reader", "Tree", "judge_names"]
