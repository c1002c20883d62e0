"""The public class: data in, questions and descriptions, as the compiled core has them."""

from __future__ import annotations

import operator
from functools import partial
from typing import TYPE_CHECKING, TypeVar

from turtlewire.errors import CdrError, TransformException
from turtlewire.geometry.poses import Pose, canonical, compose
from turtlewire.tf.plain import batch, inspection
from turtlewire.tf.plain.checks import check_frames, nanoseconds, numbers
from turtlewire.tf.plain.failure import Failure, Question, Refusal, Verdict
from turtlewire.tf.plain.report import frames_as_dot, frames_as_string, frames_as_yaml
from turtlewire.tf.plain.shared_tree import SharedTree
from turtlewire.tf.plain.tf_message import decode_tf_message
from turtlewire.tf.plain.transform import Transform
from turtlewire.tf.plain.tree import NO_PARENT, judge_names
from turtlewire.tf.status import LookupStatus

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlewire.geometry.quaternions import Quaternion, Vector

_Answer = TypeVar("_Answer")

FOREVER = 2**63 - 1
_FEWEST_FRAMES = 2  # of one transform


class Buffer(SharedTree):
    """The transforms of a tree of frames over time. Safe for use from many threads.

    Args:
        cache_time_ns: How long samples are kept, counted back from the newest of their link; None:
            forever.
        max_frames: How many frames it takes; transforms of further ones are refused. None: no
            limit.
    """

    __module__ = "turtlewire"

    def __init__(
        self, cache_time_ns: int | None = 10_000_000_000, max_frames: int | None = None
    ) -> None:
        (keep,) = nanoseconds(cache_time_ns=FOREVER if cache_time_ns is None else cache_time_ns)
        if keep < 0:
            raise ValueError("cache_time_ns must not be negative")
        if max_frames is not None:
            max_frames = operator.index(max_frames)
            if max_frames < _FEWEST_FRAMES:
                raise ValueError("max_frames must be at least 2")
        super().__init__(keep, max_frames)

    @property
    def cache_time_ns(self) -> int | None:
        """Time for which samples are kept; None for no limit."""
        return None if self._tree.keep == FOREVER else self._tree.keep

    @property
    def max_frames(self) -> int | None:
        """Largest number of frames; None for no limit."""
        return self._tree.max_frames

    @property
    def is_full(self) -> bool:
        """True if a frame was refused because of max_frames, since frames were last removed."""
        return self._tree.is_full

    lookup_batch = batch.lookup_batch
    lookup_all = batch.lookup_all
    transform_points = batch.transform_points
    lookup_velocity = batch.lookup_velocity
    extrapolate_transform = inspection.extrapolate_transform
    lookup_latest = inspection.lookup_latest
    remove_frame = inspection.remove_frame
    remove_stale = inspection.remove_stale
    samples = inspection.samples
    stamps = inspection.stamps
    set_transforms = inspection.set_transforms
    _describe_links = inspection.describe_links
    _describe_refusals = inspection.describe_refusals
    _describe_malformed = inspection.describe_malformed
    _rename_sender = inspection.rename_sender
    _fault = inspection.fault

    # -- data in

    def set_transform(
        self,
        parent_frame: str,
        child_frame: str,
        stamp_ns: int,
        translation: Vector,
        rotation: Quaternion,
        static: bool = False,
        authority: str = "default_authority",
    ) -> str:
        """Add one sample: the pose of child_frame in parent_frame at a time.

        Returns:
            An empty string if the sample was accepted, else tf2's reason for refusing it.
        """
        check_frames(parent_frame=parent_frame, child_frame=child_frame, authority=authority)
        (stamp_ns,) = nanoseconds(stamp_ns=stamp_ns)
        x, y, z = numbers("translation", translation, 3)
        qx, qy, qz, qw = numbers("rotation", rotation, 4)
        pose = (x, y, z, qx, qy, qz, qw)
        with self._changed:
            verdict = self._tree.set(
                parent_frame, child_frame, stamp_ns, pose, authority, static=static
            )
            if verdict is Verdict.ACCEPTED:
                self._changed.notify_all()
        if verdict is not Verdict.ACCEPTED:
            return Refusal(verdict, parent_frame, child_frame, stamp_ns, pose, authority).explain()
        self._call_listeners()
        return ""

    def ingest(self, cdr: bytes, static: bool = False, authority: str = "default_authority") -> int:
        """Add the transforms of one tf2_msgs/msg/TFMessage: CDR bytes with their 4-byte header.

        Returns:
            How many were accepted.

        Raises:
            CdrError: The bytes are malformed; nothing of them was added.
        """
        check_frames(authority=authority)
        try:
            transforms = decode_tf_message(bytes(memoryview(cdr)))
        except CdrError as error:
            with self._changed:
                fault = str(error).removeprefix("not a TFMessage: ")
                sender = self._tree.shown_senders.get(authority, authority)
                self._tree.refusals.add_malformed(fault, sender)
            raise
        accepted = 0
        with self._changed:
            for stamp, parent, child, pose in transforms:
                try:
                    names = parent.decode(), child.decode()
                except UnicodeDecodeError:
                    verdict = judge_names(_escaped(parent), _escaped(child))
                    shown = (_shown(parent), _shown(child))
                    self._tree.refusals.add(Refusal(verdict, *shown, stamp, pose, authority))
                    continue
                verdict = self._tree.set(*names, stamp, pose, authority, static=static)
                accepted += verdict is Verdict.ACCEPTED
            if accepted:
                self._changed.notify_all()
        if accepted:
            self._call_listeners()
        return accepted

    def clear(self) -> None:
        """Forget all samples. Frame names and static transforms stay, as in tf2."""
        with self._changed:
            self._tree.clear()

    # -- questions

    def lookup_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> Transform:
        """Return the pose of source_frame in target_frame at one time: ``target_from_source``.

        A stamp of 0 asks for the latest time that all links have reached.

        Raises:
            InvalidArgumentException: A frame id is empty or starts with a slash.
            LookupException: A frame does not exist.
            ConnectivityException: The frames are not in one tree.
            ExtrapolationException: The data does not reach the time.
        """
        check_frames(target_frame=target_frame, source_frame=source_frame)
        (stamp_ns,) = nanoseconds(stamp_ns=stamp_ns)
        stamp, pose = self._raising(
            partial(self._tree.lookup, target_frame, source_frame, stamp_ns, "lookupTransform"),
            timeout_ns,
        )
        return Transform(target_frame, source_frame, stamp, pose[:3], pose[3:])

    def lookup_transform_full(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> Transform:
        """Return the pose of source_frame at one time in target_frame at another time.

        ``fixed_frame`` is a frame that did not move between the two times.
        """
        ask = self._full_question(
            self._full, target_frame, target_stamp_ns, source_frame, source_stamp_ns, fixed_frame
        )
        stamp, pose = self._raising(ask, timeout_ns)
        return Transform(target_frame, source_frame, stamp, pose[:3], pose[3:])

    def can_transform(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> bool:
        """Return True if lookup_transform with the same arguments gives an answer."""
        return not self.can_transform_reason(target_frame, source_frame, stamp_ns, timeout_ns)

    def can_transform_reason(
        self, target_frame: str, source_frame: str, stamp_ns: int = 0, timeout_ns: int = 0
    ) -> str:
        """Return an empty string if can_transform is true, else tf2's text of why it is not."""
        check_frames(target_frame=target_frame, source_frame=source_frame)
        (stamp_ns,) = nanoseconds(stamp_ns=stamp_ns)
        return self._reason(
            partial(self._tree.lookup, target_frame, source_frame, stamp_ns, "canTransform"),
            timeout_ns,
        )

    def can_transform_full(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> bool:
        """Return True if lookup_transform_full with the same arguments gives an answer."""
        return not self.can_transform_full_reason(
            target_frame, target_stamp_ns, source_frame, source_stamp_ns, fixed_frame, timeout_ns
        )

    def can_transform_full_reason(
        self,
        target_frame: str,
        target_stamp_ns: int,
        source_frame: str,
        source_stamp_ns: int,
        fixed_frame: str,
        timeout_ns: int = 0,
    ) -> str:
        """An empty string if can_transform_full is true, else tf2's text of why it is not."""
        ask = self._full_question(
            self._can_full,
            target_frame,
            target_stamp_ns,
            source_frame,
            source_stamp_ns,
            fixed_frame,
        )
        return self._reason(ask, timeout_ns)

    def latest_common_time(self, target_frame: str, source_frame: str) -> int:
        """The newest time in nanoseconds that all dynamic links between the frames have reached.

        0 if all links are static.
        """
        check_frames(target_frame=target_frame, source_frame=source_frame)
        with self._changed:
            try:
                self._tree.check_name(target_frame, "get_latest_common_time", "")
                self._tree.check_name(source_frame, "get_latest_common_time", "")
                return self._tree.latest_common_time(target_frame, source_frame)
            except Failure as failure:
                if failure.status in {LookupStatus.NOT_CONNECTED, LookupStatus.LOOP}:
                    raise TransformException(str(failure)) from None
                raise self._error(failure) from None

    # -- descriptions

    def frame_strings(self) -> list[str]:
        """Return the names of all frames ever received, in order of arrival."""
        with self._changed:
            return list(self._tree.frames)

    def frame_exists(self, frame: str) -> bool:
        """Return True if the frame was ever received."""
        with self._changed:
            return frame in self._tree.frames or frame == NO_PARENT

    def all_frames_as_string(self) -> str:
        """tf2's list of frames and parents, one line each."""
        with self._changed:
            return frames_as_string(self._tree.links_in_order())

    def all_frames_as_yaml(self, now: float = 0.0) -> str:
        """tf2's YAML of frames, parents, senders, rates and ages.

        ``now`` in seconds adds the delay.
        """
        with self._changed:
            return frames_as_yaml(self._tree.links_in_order(), now, empty=not self._tree.frames)

    def all_frames_as_dot(self, now: float = 0.0) -> str:
        """tf2's Graphviz text of the tree; ``now`` in seconds adds ages."""
        with self._changed:
            return frames_as_dot(list(self._tree.frames), self._tree.links_in_order(), now)

    def _repr_svg_(self) -> str:
        """Return the tree of frames as SVG, for notebooks."""
        from turtlewire.tf.notebook import buffer_svg

        return buffer_svg(self)

    def _full_question(
        self,
        ask: Callable[..., _Answer],
        target: str,
        target_stamp: int,
        source: str,
        source_stamp: int,
        fixed: str,
    ) -> Callable[[], _Answer]:
        check_frames(target_frame=target, source_frame=source, fixed_frame=fixed)
        target_stamp, source_stamp = nanoseconds(
            target_stamp_ns=target_stamp, source_stamp_ns=source_stamp
        )
        return partial(ask, target, target_stamp, source, source_stamp, fixed)

    def _full(
        self, target: str, target_stamp: int, source: str, source_stamp: int, fixed: str
    ) -> tuple[int, Pose]:
        self._check_names(target, source, fixed, "lookupTransform")
        _, fixed_from_source = self._tree.lookup(fixed, source, source_stamp, "lookupTransform")
        stamp, target_from_fixed = self._tree.lookup(target, fixed, target_stamp, "lookupTransform")
        return stamp, canonical(compose(target_from_fixed, fixed_from_source))

    def _can_full(
        self, target: str, target_stamp: int, source: str, source_stamp: int, fixed: str
    ) -> None:
        self._check_names(target, source, fixed, "canTransform")
        self._tree.lookup(target, fixed, target_stamp, "canTransform")
        self._tree.lookup(fixed, source, source_stamp, "canTransform")

    def _check_names(self, target: str, source: str, fixed: str, question: Question) -> None:
        self._tree.check_name(target, question, "target_frame")
        self._tree.check_name(source, question, "source_frame")
        self._tree.check_name(fixed, question, "fixed_frame")


def _escaped(name: bytes) -> str:
    """Return a name as the tree judges it: bytes that are not UTF-8 become surrogates."""
    return name.removeprefix(b"/").decode(errors="surrogateescape")


def _shown(name: bytes) -> str:
    return name.removeprefix(b"/").decode(errors="replace")
