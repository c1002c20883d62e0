"""The reasons for failed lookups and rejected transforms, in tf2's words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from enum import Enum
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

from turtlewire import errors
from turtlewire.tf.plain.status import LookupStatus

if TYPE_CHECKING:
    from turtlewire.geometry.poses import Pose
    from turtlewire.tf.plain.link import LinkSamples

Question: TypeAlias = Literal["lookupTransform", "canTransform", "get_latest_common_time"]


_STATIC_CACHE_IS_EMPTY = "Static cache is empty"


def seconds(stamp: int) -> float:
    """Convert nanoseconds to seconds as tf2 does, whose error texts show the rounding."""
    whole, rest = divmod(stamp, 1_000_000_000)
    return whole + 1e-9 * rest


class Failure(Exception):
    """A question has no answer; the buffer turns it into a TransformException.

    Attributes:
        status: The error, as batches report it.
        details: The attributes of the exception by name; see turtlewire.errors.
        hopeless: Whether more data cannot help.
    """

    def __init__(
        self,
        text: str,
        status: LookupStatus,
        details: Mapping[str, Any] | None = None,
        *,
        hopeless: bool = False,
    ) -> None:
        super().__init__(text)
        self.status = status
        self.details = details or {}
        self.hopeless = hopeless

    def without_reason(self) -> Failure:
        """Return it as can_transform words a static link that was cleared: without the reason."""
        return Failure(str(self).removeprefix(_STATIC_CACHE_IS_EMPTY), self.status)


ERRORS: dict[LookupStatus, type[errors.TransformException]] = {
    LookupStatus.EMPTY_NAME: errors.InvalidArgumentException,
    LookupStatus.SLASH_NAME: errors.InvalidArgumentException,
    LookupStatus.UNKNOWN_FRAME: errors.LookupException,
    LookupStatus.NOT_CONNECTED: errors.ConnectivityException,
    LookupStatus.LOOP: errors.LookupException,
    LookupStatus.NO_DATA: errors.ExtrapolationException,
    LookupStatus.FUTURE: errors.ExtrapolationException,
    LookupStatus.PAST: errors.ExtrapolationException,
    LookupStatus.NO_STATIC_DATA: errors.LookupException,
}

#: `ExtrapolationException.reason`.
_REASONS = {
    LookupStatus.NO_DATA: "no data",
    LookupStatus.FUTURE: "future",
    LookupStatus.PAST: "past",
}


def name_failure(status: LookupStatus, name: str, question: Question, argument: str) -> Failure:
    """Return the failure of a question with an unknown or invalid frame id."""
    why = {
        LookupStatus.EMPTY_NAME: "cannot be empty",
        LookupStatus.SLASH_NAME: "cannot start with a '/'",
    }.get(status, "")
    where = question if question == "get_latest_common_time" else f"{question} argument {argument}"
    if question == "canTransform":
        why = f"in tf2 frame_ids {why}" if why else "frame does not exist"
        text = f'Invalid frame ID "{name}" passed to {where} - {why}'
    elif status == LookupStatus.UNKNOWN_FRAME:
        text = f'"{name}" passed to {where} does not exist. '
    else:
        text = f'Invalid argument "{name}" passed to {where} - in tf2 frame_ids {why}'
    unknown = status == LookupStatus.UNKNOWN_FRAME
    return Failure(text, status, {"frame": name}, hopeless=not unknown)


def connection_failure(target: str, source: str, target_root: str, source_root: str) -> Failure:
    """Return the failure of a lookup between frames of different trees."""
    return Failure(
        f"Could not find a connection between '{target}' and '{source}' because they are not "
        "part of the same tree."
        "Tf has two or more unconnected trees.",
        LookupStatus.NOT_CONNECTED,
        {
            "target_frame": target,
            "source_frame": source,
            "target_root": target_root,
            "source_root": source_root,
        },
    )


def loop_failure(frames: str) -> Failure:
    """Return the failure of a lookup in a tree with a loop."""
    return Failure(
        f"The tf tree is invalid because it contains a loop.\n{frames}\n", LookupStatus.LOOP
    )


def time_failure(
    status: LookupStatus,
    child: str,
    link: LinkSamples,
    stamp: int | None,
    target: str,
    source: str,
    keep: int,
    *,
    tells_emptied: bool,
) -> Failure:
    """Return the failure of a lookup at a time that the data of a link does not reach."""
    looking = f", when looking up transform from frame [{source}] to frame [{target}]"
    if link.static:
        return Failure(f"{_STATIC_CACHE_IS_EMPTY}{looking}", LookupStatus.NO_STATIC_DATA)
    asked, oldest, newest = (f"{seconds(t or 0):.6f}" for t in (stamp, link.oldest, link.newest))
    if status == LookupStatus.FUTURE:
        text = (
            f"Lookup would require extrapolation into the future.  Requested time {asked} "
            f"but the latest data is at time {newest}"
        )
    elif status == LookupStatus.PAST:
        text = (
            f"Lookup would require extrapolation into the past.  Requested time {asked} "
            f"but the earliest data is at time {oldest}"
        )
    elif link.has_data or tells_emptied:
        text = (
            f"Lookup would require extrapolation at time {asked}, "
            f"but only time {newest} is in the buffer"
        )
    else:
        text = ""
    return Failure(
        f"{text}{looking}",
        status,
        {
            "reason": _REASONS[status],
            "target_frame": target,
            "source_frame": source,
            "parent_frame": link.parent,
            "child_frame": child,
            "requested_ns": stamp,
            "oldest_ns": link.oldest if link.has_data else None,
            "newest_ns": link.reached,
        },
        hopeless=status != LookupStatus.FUTURE
        and link.has_data
        and stamp is not None
        and stamp < link.newest - keep,
    )


def _values(numbers: Sequence[float]) -> str:
    texts = [
        "-nan" if math.isnan(value) and math.copysign(1.0, value) < 0.0 else f"{value:.6f}"
        for value in numbers
    ]
    return f"({' '.join(texts)})"


class Verdict(Enum):
    """The outcome of adding a transform; the values are the names in statistics."""

    ACCEPTED = "accepted"
    SELF_TRANSFORM = "self_transform"
    NO_CHILD_FRAME = "no_child_frame"
    NO_PARENT_FRAME = "no_parent_frame"
    NAN_VALUE = "nan_value"
    OLD_DATA = "old_data"
    RESERVED_NAME = "reserved_name"
    BAD_NAME = "bad_name"
    TOO_MANY_FRAMES = "too_many_frames"
    DENORMALIZED = "denormalized"


#: `InvalidTransformError.reason`.
_REFUSAL_REASONS: dict[Verdict, Any] = {
    Verdict.SELF_TRANSFORM: "self",
    Verdict.NO_CHILD_FRAME: "no child",
    Verdict.NO_PARENT_FRAME: "no parent",
    Verdict.NAN_VALUE: "nan",
    Verdict.OLD_DATA: "old",
    Verdict.RESERVED_NAME: "bad name",
    Verdict.BAD_NAME: "bad name",
    Verdict.TOO_MANY_FRAMES: "too many frames",
    Verdict.DENORMALIZED: "denormalized",
}


class Refusal(NamedTuple):
    """The outcome of adding a transform, with the reason if the verdict is not ACCEPTED."""

    verdict: Verdict
    parent: str
    child: str
    stamp: int
    pose: Pose
    authority: str

    def check(self, row: int | None = None) -> None:
        """Raise InvalidTransformError unless the transform was accepted."""
        if self.verdict is Verdict.ACCEPTED:
            return
        error = errors.InvalidTransformError(self.explain())
        error.reason = _REFUSAL_REASONS[self.verdict]
        if self.verdict is Verdict.NAN_VALUE and not any(self.pose[3:]):
            error.reason = "zero quaternion"
        error.parent_frame, error.child_frame = self.parent, self.child
        error.sender, error.row = self.authority, row
        raise error

    def explain(self) -> str:
        """tf2's text for its own reasons, ours for the reasons that only we have."""
        child, authority = self.child, self.authority
        ignoring = f'Ignoring transform from authority "{authority}"'
        return {
            Verdict.ACCEPTED: "",
            Verdict.SELF_TRANSFORM: f"TF_SELF_TRANSFORM: {ignoring} with frame_id and  "
            f'child_frame_id "{child}" because they are the same',
            Verdict.NO_CHILD_FRAME: f"TF_NO_CHILD_FRAME_ID: {ignoring} "
            "because child_frame_id not set ",
            Verdict.NO_PARENT_FRAME: "TF_NO_FRAME_ID: Ignoring transform with child_frame_id "
            f'"{child}"'
            f'  from authority "{authority}" because frame_id not set',
            Verdict.NAN_VALUE: f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" '
            f'from authority "{authority}" because of a nan value in the transform '
            f"{_values(self.pose[:3])} {_values(self.pose[3:])}",
            Verdict.DENORMALIZED: "TF_DENORMALIZED_QUATERNION: Ignoring transform for "
            f'child_frame_id "{child}" from authority "{authority}" because of an invalid '
            f"quaternion in the transform {_values(self.pose[3:])}",
            Verdict.OLD_DATA: f"TF_OLD_DATA ignoring data from the past for frame {child} "
            f"at time {seconds(self.stamp):.6f} according to authority {authority}\n"
            "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained",
            Verdict.RESERVED_NAME: f'{ignoring}: "NO_PARENT" is the name tf2 keeps '
            "for the absence of a parent",
            Verdict.BAD_NAME: f"{ignoring}: a frame id must be UTF-8 text without NUL, "
            "of at most 4096 bytes",
            Verdict.TOO_MANY_FRAMES: f'{ignoring}: frame "{child}" or its parent "{self.parent}" '
            "is new, and the buffer holds as many frames as max_frames allows",
        }[self.verdict]
