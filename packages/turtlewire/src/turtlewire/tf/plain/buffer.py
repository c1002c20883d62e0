"""The public class, with the methods of the compiled core."""

from __future__ import annotations

import operator
from collections.abc import Callable
from functools import partial
from typing import TypeVar

from turtlewire.call_errors import explain_calls
from turtlewire.errors import TransformException
from turtlewire.geometry.poses import Pose, canonical, compose
from turtlewire.tf.plain import additions, batch, inspection
from turtlewire.tf.plain.checks import check_frames, moments, nanoseconds
from turtlewire.tf.plain.failure import Failure, Question
from turtlewire.tf.plain.report import frames_as_dot, frames_as_string, frames_as_yaml
from turtlewire.tf.plain.rules import rules_of
from turtlewire.tf.plain.shared_tree import SharedTree
from turtlewire.tf.plain.status import LookupStatus
from turtlewire.tf.plain.transform import Transform
from turtlewire.tf.plain.tree import NO_PARENT

_Answer = TypeVar("_Answer")

FOREVER = 2**63 - 1
_FEWEST_FRAMES = 2  # of one transform


@explain_calls
class Buffer(SharedTree):
    """The transforms of a tree of frames over time. Safe for use from many threads.

    Args:
        cache_time_ns: How long samples are kept, counted back from the newest of their link; None:
            forever.
        max_frames: How many frames it takes; transforms of further ones are refused. None: no
            limit.
    """

    __module__ = "turtlewire"
    __slots__ = ()

    def __init__(
        self, cache_time_ns: int | None = 10_000_000_000, max_frames: int | None = None
    ) -> None:
        (keep,) = nanoseconds(cache_time_ns=FOREVER if cache_time_ns is None else cache_time_ns)
        if keep < 0:
            raise ValueError("cache_time_ns must not be negative")
        if max_frames is not None:
            if not hasattr(max_frames, "__index__"):
                given = type(max_frames).__name__
                raise TypeError(f"max_frames must be an int or None, not {given}")
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

    set_transform = additions.set_transform
    set_static_transform = additions.set_static_transform
    _set_transform = additions.set_or_explain
    add_tf_message = additions.add_tf_message
    lookup_transforms = batch.lookup_transforms
    lookup_all = batch.lookup_all
    transform_points = batch.transform_points
    lookup_velocity = batch.lookup_velocity
    lookup_newest = inspection.lookup_newest
    time_range = inspection.time_range
    remove_frame = inspection.remove_frame
    remove_stale = inspection.remove_stale
    samples = inspection.samples
    _stamps = inspection.stamps
    set_transforms = inspection.set_transforms
    _describe_links = inspection.describe_links
    _describe_refusals = inspection.describe_refusals
    _refusal_kinds = inspection.refusal_kinds
    _describe_malformed = inspection.describe_malformed
    _rename_sender = inspection.rename_sender
    _fault = inspection.fault

    def clear(self) -> None:
        """Forget all samples. Frame names and static transforms stay, as in tf2."""
        with self._lock:
            self._tree.clear()

    # -- questions

    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        stamp_ns: int | None = None,
        *,
        timeout_ns: int = 0,
        extrapolate_ns: int = 0,
        fixed_frame: str | None = None,
        target_stamp_ns: int | None = None,
    ) -> Transform:
        """Return the pose of source_frame in target_frame at one time: ``target_from_source``.

        Args:
            target_frame: The frame in which the answer is expressed.
            source_frame: The frame whose pose is asked for.
            stamp_ns: The time of the data; None asks for the latest time known to the whole chain.
            timeout_ns: How long to wait for data; 0 does not wait.
            extrapolate_ns: How far outside of a link's data the motion between its two outermost
                samples is taken to go on; tf2 never does this.
            fixed_frame: A frame that does not move: the answer is the pose of the source at
                ``stamp_ns``, as the target sees it at ``target_stamp_ns``.
            target_stamp_ns: The time of the target with a fixed frame; None is the latest.

        Raises:
            InvalidArgumentException: A frame id is empty or starts with a slash.
            LookupException: A frame does not exist.
            ConnectivityException: The frames are not in one tree.
            ExtrapolationException: The data does not reach the time.
        """
        ask = self._question(
            self._find,
            (target_frame, source_frame, stamp_ns),
            (extrapolate_ns, fixed_frame, target_stamp_ns),
        )
        stamp, pose = self._raising(partial(ask, "lookupTransform"), timeout_ns)
        return Transform(target_frame, source_frame, pose[:3], pose[3:], stamp_ns=stamp)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        stamp_ns: int | None = None,
        *,
        timeout_ns: int = 0,
        extrapolate_ns: int = 0,
        fixed_frame: str | None = None,
        target_stamp_ns: int | None = None,
    ) -> bool:
        """Return True if lookup_transform with the same arguments gives an answer."""
        return not self._can_transform_reason(
            target_frame,
            source_frame,
            stamp_ns,
            timeout_ns=timeout_ns,
            extrapolate_ns=extrapolate_ns,
            fixed_frame=fixed_frame,
            target_stamp_ns=target_stamp_ns,
        )

    def explain(
        self,
        target_frame: str,
        source_frame: str,
        stamp_ns: int | None = None,
        *,
        timeout_ns: int = 0,
        extrapolate_ns: int = 0,
        fixed_frame: str | None = None,
        target_stamp_ns: int | None = None,
    ) -> TransformException | None:
        """Return what lookup_transform would raise; None if it gives an answer."""
        try:
            self.lookup_transform(
                target_frame,
                source_frame,
                stamp_ns,
                timeout_ns=timeout_ns,
                extrapolate_ns=extrapolate_ns,
                fixed_frame=fixed_frame,
                target_stamp_ns=target_stamp_ns,
            )
        except TransformException as error:
            return error.with_traceback(None)
        return None

    def _can_transform_reason(
        self,
        target_frame: str,
        source_frame: str,
        stamp_ns: int | None = None,
        *,
        timeout_ns: int = 0,
        extrapolate_ns: int = 0,
        fixed_frame: str | None = None,
        target_stamp_ns: int | None = None,
    ) -> str:
        """Return an empty string if can_transform is true, else tf2's text of why it is not."""
        ask = self._question(
            self._test,
            (target_frame, source_frame, stamp_ns),
            (extrapolate_ns, fixed_frame, target_stamp_ns),
        )
        return self._reason(partial(ask, "canTransform"), timeout_ns)

    def _follow_tf2(self, year: int) -> None:
        """Answer as tf2 of a year's release from now on; to be called before data comes in."""
        with self._lock:
            self._tree.rules = rules_of(year)

    def _latest_common_time(self, target_frame: str, source_frame: str) -> int:
        """ROS 2's question; its time 0 means static links."""
        check_frames(target_frame=target_frame, source_frame=source_frame)
        with self._lock:
            try:
                self._tree.check_name(target_frame, "get_latest_common_time", "")
                self._tree.check_name(source_frame, "get_latest_common_time", "")
                return self._tree.latest_common_time(target_frame, source_frame) or 0
            except Failure as failure:
                if failure.status in {LookupStatus.NOT_CONNECTED, LookupStatus.LOOP}:
                    raise TransformException(str(failure)) from None
                raise self._error(failure) from None

    # -- descriptions

    def frames(self) -> list[str]:
        """Return the names of all frames ever received, in order of arrival."""
        with self._lock:
            return list(self._tree.frames)

    def _knows(self, frame: str) -> bool:
        with self._lock:
            return frame in self._tree.frames or frame == NO_PARENT

    def _frames_as_string(self) -> str:
        """tf2's list of frames and parents, one line each."""
        with self._lock:
            return frames_as_string(self._tree.links_in_order())

    def to_yaml(self, *, now_ns: int | None = None) -> str:
        """tf2's YAML of frames, parents, senders, rates and ages; ``now_ns`` adds the delay."""
        now = _seconds(now_ns)
        with self._lock:
            return frames_as_yaml(self._tree.links_in_order(), now, empty=not self._tree.frames)

    def to_dot(self, *, now_ns: int | None = None) -> str:
        """tf2's Graphviz text of the tree; ``now_ns`` adds ages."""
        now = _seconds(now_ns)
        with self._lock:
            return frames_as_dot(list(self._tree.frames), self._tree.links_in_order(), now)

    def _repr_svg_(self) -> str:
        """Return the tree of frames as SVG, for notebooks."""
        from turtlewire.tf.notebook import buffer_svg

        return buffer_svg(self)

    def _question(
        self,
        ask: Callable[..., _Answer],
        plain: tuple[str, str, int | None],
        rest: tuple[int, str | None, int | None],
    ) -> Callable[[Question], _Answer]:
        """Check what the questions take, and return the question without its wording."""
        (target, source, stamp), (extrapolate, fixed, target_stamp) = plain, rest
        check_frames(target_frame=target, source_frame=source, fixed_frame=fixed or "")
        stamp, target_stamp = moments(stamp_ns=stamp, target_stamp_ns=target_stamp)
        (extrapolate,) = nanoseconds(extrapolate_ns=extrapolate)
        if extrapolate < 0:
            raise ValueError("extrapolate_ns must not be negative")
        if fixed is None and target_stamp is not None:
            raise ValueError(
                "target_stamp_ns needs fixed_frame, the frame that joins the two times"
            )
        return partial(ask, target, source, stamp, extrapolate, fixed, target_stamp)

    def _find(
        self,
        target: str,
        source: str,
        stamp: int | None,
        beyond: int,
        fixed: str | None,
        target_stamp: int | None,
        question: Question,
    ) -> tuple[int | None, Pose]:
        look = partial(self._tree.lookup, question=question, beyond=beyond)
        if fixed is None:
            return look(target, source, stamp)
        self._check_names(target, source, fixed, question)
        _, fixed_from_source = look(fixed, source, stamp)
        stamp, target_from_fixed = look(target, fixed, target_stamp)
        # In every release by way of matrices, which normalise.
        return stamp, canonical(compose(canonical(target_from_fixed), fixed_from_source))

    def _test(
        self,
        target: str,
        source: str,
        stamp: int | None,
        beyond: int,
        fixed: str | None,
        target_stamp: int | None,
        question: Question,
    ) -> None:
        """Ask as `_find`; tf2 asks for the two steps in the other order here."""
        look = partial(self._tree.lookup, question=question, beyond=beyond)
        steps = [(target, source, stamp)]
        if fixed is not None:
            self._check_names(target, source, fixed, question)
            steps = [(target, fixed, target_stamp), (fixed, source, stamp)]
        # tf2 continues past a cleared static link, and then reports the failure of the other half.
        for cleared in reversed([_cleared_static(look, step) for step in steps]):
            if cleared is not None:
                raise cleared.without_reason()

    def _check_names(self, target: str, source: str, fixed: str, question: Question) -> None:
        self._tree.check_name(target, question, "target_frame")
        self._tree.check_name(source, question, "source_frame")
        self._tree.check_name(fixed, question, "fixed_frame")


def _cleared_static(
    look: Callable[..., object], step: tuple[str, str, int | None]
) -> Failure | None:
    """Look up; return the failure if a static link was cleared, and raise any other."""
    try:
        look(*step)
    except Failure as failure:
        if failure.status != LookupStatus.NO_STATIC_DATA:
            raise
        return failure
    return None


def _seconds(now_ns: int | None) -> float:
    (now,) = moments(now_ns=now_ns)
    return (now or 0) / 1e9
