"""tf2's own words for failures and refusals, and its descriptions of the tree."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from turtlewire import errors
from turtlewire.tf.status import LookupStatus

if TYPE_CHECKING:
    from collections.abc import Mapping

    from turtlewire.tf.plain.links import Link
    from turtlewire.tf.plain.poses import Pose

Question: TypeAlias = Literal["lookupTransform", "canTransform", "get_latest_common_time"]


def _seconds(stamp: int) -> float:
    """As tf2 turns times and durations into seconds; its texts show the rounding."""
    whole, rest = divmod(stamp, 1_000_000_000)
    return whole + 1e-9 * rest


class Failure(Exception):
    """A question has no answer; the buffer turns it into a TransformException.

    Attributes:
        status: What is wrong, as batches tell it.
        details: What the exception tells beyond its text; see turtlewire.errors.
        hopeless: Whether more data cannot help.
    """

    def __init__(
        self,
        text: str,
        status: LookupStatus,
        details: tuple[Any, ...] = (),
        *,
        hopeless: bool = False,
    ) -> None:
        super().__init__(text)
        self.status = status
        self.details = details
        self.hopeless = hopeless


ERRORS: dict[LookupStatus, type[errors.TransformException]] = {
    LookupStatus.EMPTY_NAME: errors.InvalidArgumentException,
    LookupStatus.SLASH_NAME: errors.InvalidArgumentException,
    LookupStatus.UNKNOWN_FRAME: errors.LookupException,
    LookupStatus.NOT_CONNECTED: errors.ConnectivityException,
    LookupStatus.LOOP: errors.LookupException,
    LookupStatus.NO_DATA: errors.NoDataForExtrapolationException,
    LookupStatus.FUTURE: errors.ForwardExtrapolationException,
    LookupStatus.PAST: errors.BackwardExtrapolationException,
}


def name_failure(status: LookupStatus, name: str, question: Question, argument: str) -> Failure:
    """A frame id that cannot be asked for."""
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
    return Failure(text, status, (name,), hopeless=status != LookupStatus.UNKNOWN_FRAME)


def connection_failure(target: str, source: str, target_root: str, source_root: str) -> Failure:
    """Two frames of different trees."""
    return Failure(
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the same tree."
        "Tf has two or more unconnected trees.",
        LookupStatus.NOT_CONNECTED,
        (target, source, target_root, source_root),
    )


def loop_failure(frames: str) -> Failure:
    """A walk that does not end."""
    return Failure(
        f"The tf tree is invalid because it contains a loop.\n{frames}\n", LookupStatus.LOOP
    )


def time_failure(
    status: LookupStatus, child: str, link: Link, stamp: int, target: str, source: str, keep: int
) -> Failure:
    """A link whose data does not reach a time."""
    asked, oldest, newest = (f"{_seconds(t):.6f}" for t in (stamp, link.oldest, link.newest))
    if status == LookupStatus.FUTURE:
        text = f"Lookup would require extrapolation into the future.  Requested time {asked} but the latest data is at time {newest}"
    elif status == LookupStatus.PAST:
        text = f"Lookup would require extrapolation into the past.  Requested time {asked} but the earliest data is at time {oldest}"
    elif link.has_data:
        text = f"Lookup would require extrapolation at time {asked}, but only time {newest} is in the buffer"
    else:
        text = ""
    return Failure(
        f"{text}, when looking up transform from frame [{source}] to frame [{target}]",
        status,
        (target, source, link.parent, child, stamp, link.oldest, link.newest, link.has_data),
        hopeless=status != LookupStatus.FUTURE and link.has_data and stamp < link.newest - keep,
    )


def _values(pose: Pose) -> str:
    numbers = [
        "-nan" if math.isnan(value) and math.copysign(1.0, value) < 0.0 else f"{value:.6f}"
        for value in pose
    ]
    return f"({' '.join(numbers[:3])}) ({' '.join(numbers[3:])})"


def refusal(verdict: str, child: str, stamp: int, pose: Pose, authority: str) -> str:
    """Why a transform was not taken."""
    return {
        "self": f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and  child_frame_id "{child}" '
        "because they are the same",
        "no child": f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because child_frame_id not set ',
        "no parent": f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority "{authority}" '
        "because frame_id not set",
        "nan": f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
        f"because of a nan value in the transform {_values(pose)}",
        "old": f"TF_OLD_DATA ignoring data from the past for frame {child} at time {_seconds(stamp):.6f} "
        f"according to authority {authority}\n"
        "Possible reasons are listed at http://wiki.ros.org/tf/Errors%20explained",
        "reserved": f'Ignoring transform from authority "{authority}": "NO_PARENT" is the name tf2 keeps for the absence of a parent',
        "name": f'Ignoring transform from authority "{authority}": a frame id must be UTF-8 text without NUL, of at most 4096 bytes',
    }[verdict]


def _rate(link: Link) -> float:
    return link.length / max(_seconds(link.newest - link.oldest), 0.0001)


def frames_as_string(links: Mapping[str, Link]) -> str:
    """tf2's list of frames and parents."""
    return "".join(
        f"Frame {child} exists with parent {link.parent}.\n" for child, link in links.items()
    )


def frames_as_yaml(links: Mapping[str, Link], now: float, *, empty: bool) -> str:
    """tf2's YAML; ``now`` in seconds adds the delay."""
    if empty:
        return "[]"
    text = []
    for child, link in links.items():
        if not link.has_data:
            continue
        text.append(
            f"{child}: \n  parent: '{link.parent}'\n  broadcaster: '{link.sender}'\n  rate: {_rate(link):.3f}\n"
            f"  most_recent_transform: {_seconds(link.newest):.6f}\n  oldest_transform: {_seconds(link.oldest):.6f}\n"
        )
        if now > 0.0:
            text.append(f"  transform_delay: {now - _seconds(link.newest):.3f}\n")
        text.append(f"  buffer_length: {_seconds(link.newest - link.oldest):.3f}\n")
    return "".join(text)


def frames_as_dot(frames: list[str], links: Mapping[str, Link], now: float) -> str:
    """tf2's Graphviz text; ``now`` in seconds adds ages."""
    text = ["digraph G {\n"]
    if not frames:
        text.append('"no tf data recieved"')
    for child, link in links.items():
        age = f"( {now - _seconds(link.newest):.3f} sec old)" if now > 0.0 else ""
        text.append(
            f'"{link.parent}" -> "{child}"[label="Broadcaster: {link.sender}\\nAverage rate: {_rate(link):.3f} Hz\\n'
            f"Most recent transform: {_seconds(link.newest):.6f} {age}\\n"
            f'Buffer length: {_seconds(link.newest - link.oldest):.3f} sec\\n"];\n'
        )
    for frame in frames:
        if frame in links and links[frame].has_data:
            continue
        text.append(
            'edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        )
        if now > 0.0:
            text.append(f'"Recorded at time: {now:.6f}"[ shape=plaintext ] ;\n')
        text.append(f'}}->"{frame}";\n')
    text.append("}")
    return "".join(text)
