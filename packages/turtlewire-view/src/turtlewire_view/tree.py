"""The page's data about each frame, and the pose of one frame in another."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.errors import ExtrapolationException, TransformException
from turtlewire.geometry.conversions import euler_from_quaternion
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire_view.frames import FRAME_TIMEOUT_S

if TYPE_CHECKING:
    from turtlewire.tf.buffer import Buffer
    from turtlewire.tf.links import Link

__all__ = [
    "TreeTable",
    "missing_frame",
    "path_between",
    "relation",
    "transform_in_words",
]

_NOTHING_M = 0.005
_NOTHING_DEG = 0.5
_DIRECTIONS = (("ahead", "behind"), ("to the left", "to the right"), ("above", "below"))
#: The sender of transforms that a program sets without one: tf2's name for it helps nobody here.
_UNNAMED = "default_authority"
#: Words that are not followed by "of".
_WITHOUT_OF = ("behind", "above", "below")


def transform_in_words(
    source: str, target: str, translation: Sequence[float], rotation: Sequence[float]
) -> str:
    """Describe ``target_from_source`` in one sentence.

    Args:
        source: The frame that is looked at.
        target: The frame that looks.
        translation: Origin of the source in the target [m].
        rotation: Of the source in the target, unit quaternion xyzw.
    """
    if not all(map(math.isfinite, (*translation, *rotation))):
        return f"{source} has no finite position in {target}."
    turn = _turn_in_words(rotation)
    return f"{source} is {_place_in_words(target, translation)}, and {turn}."


def _place_in_words(target: str, translation: Sequence[float]) -> str:
    parts = [
        f"{abs(metres):.2f} m {positive if metres > 0 else negative}"
        for metres, (positive, negative) in zip(translation, _DIRECTIONS, strict=True)
        if abs(metres) >= _NOTHING_M
    ]
    if not parts:
        return f"where {target} is"
    *head, last = parts
    place = f"{', '.join(head)} and {last}" if head else last
    return f"{place}{'' if place.endswith(_WITHOUT_OF) else ' of'} {target}"


def _turn_in_words(rotation: Sequence[float]) -> str:
    x, y, z, w = rotation
    degrees = math.degrees(2 * math.atan2(math.hypot(x, y, z), abs(w)))
    if degrees < _NOTHING_DEG:
        return "looks the same way"
    yaw = math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    tilt = math.degrees(2 * math.asin(min(1.0, math.hypot(x, y))))
    if tilt < _NOTHING_DEG:
        return f"looks {abs(yaw):.0f}° further to the {'left' if yaw > 0 else 'right'}"
    return f"is turned by {degrees:.0f}°"


#: The delay of a link is the smallest age of its newest sample in this many looks, one a second.
_LOOKS = 10
#: Frames that are named where no name is similar.
_MOST_NAMED = 10


class TreeTable:
    """The rows of the tree; looked at once a second. Not thread-safe."""

    def __init__(self) -> None:
        self._delays: dict[str, deque[float]] = {}
        self._newest_ns: dict[str, int] = {}

    def rows(
        self, buffer: Buffer, now_ns: int, departed: Collection[str] = ()
    ) -> list[dict[str, Any]]:
        """Return a row for each frame with a parent, in no order.

        Its rate is in Hz, its times in seconds; a static link has neither rate, age nor delay.

        Args:
            buffer: The frames.
            now_ns: The time that ages refer to.
            departed: Moving frames whose publisher has left the graph.
        """
        links = [link for link in buffer.links() if link.samples]
        self._delays = {link.child_frame: self._delayed(link, now_ns) for link in links}
        self._newest_ns = {link.child_frame: link.newest_ns for link in links}
        return [
            {**self._row(link, now_ns), "departed": link.child_frame in departed} for link in links
        ]

    def _delayed(self, link: Link, now_ns: int) -> deque[float]:
        """The ages of new samples: what has no newer one grows older, and is not more delayed."""
        delays = self._delays.get(link.child_frame, deque(maxlen=_LOOKS))
        if self._newest_ns.get(link.child_frame) not in (None, link.newest_ns):
            delays.append(link.age_ns(now_ns) / 1e9)
        return delays

    def _row(self, link: Link, now_ns: int) -> dict[str, Any]:
        moving = not link.static
        return {
            "name": link.child_frame,
            "parent": link.parent_frame,
            "publisher": ", ".join(_publishers(link)),
            "static": link.static,
            "samples": link.samples,
            "rate": link.rate_hz if moving and link.samples > 1 else None,
            "age": link.age_ns(now_ns) / 1e9 if moving else None,
            "delay": min(self._delays[link.child_frame], default=None) if moving else None,
        }


def missing_frame(frame: str, known: Sequence[str]) -> str:
    """Return a hint if a frame does not exist, or an empty string, as before the first frame."""
    if not frame or not known or frame in known:
        return ""
    some, rest = ", ".join(known[:_MOST_NAMED]), len(known) - _MOST_NAMED
    frames = f"The frames are {some}{f' and {rest} more' if rest > 0 else ''}"
    return f"There is no frame {frame!r}. {did_you_mean(frame, known) or frames}"


def relation(buffer: Buffer, target: str, source: str, stamp_ns: int | None) -> dict[str, Any]:
    """Describe the pose of ``source`` in ``target``, or why it is unknown.

    Translations are in metres, rotations xyzw, rpy in radians about fixed axes; numbers that are
    not finite are None.
    """
    answer: dict[str, Any] = {"target": target, "source": source}
    known = buffer.frames()
    for frame in (target, source):
        if frame not in known:
            text = f"There is no frame {frame!r}."
            return {**answer, "error": text, "hint": did_you_mean(frame, known)}
    try:
        target_from_source = _lookup(buffer, target, source, stamp_ns)
    except TransformException as error:
        hint = _ended_link(buffer, error) if stamp_ns is None else ""
        return {**answer, "error": str(error), "hint": hint or error.hint}
    translation, rotation = target_from_source.translation, target_from_source.rotation
    rpy = euler_from_quaternion(rotation).tolist()
    return {
        **answer,
        "stamp": (target_from_source.stamp_ns or 0) / 1e9,
        "translation": _finite(translation),
        "rotation": _finite(rotation),
        "rpy": _finite(rpy),
        "matrix": [_finite(row) for row in np.asarray(target_from_source.as_matrix())],
        "sentence": transform_in_words(source, target, translation, rotation),
    }


def _lookup(buffer: Buffer, target: str, source: str, stamp_ns: int | None) -> Any:
    """Return the transform at a stamp, or the last one before as long as the picture shows that."""
    try:
        return buffer.lookup_transform(target, source, stamp_ns)
    except ExtrapolationException:
        if stamp_ns is None:
            raise
        newest = buffer.lookup_transform(target, source)
        if newest.stamp_ns is None or not (
            0 <= stamp_ns - newest.stamp_ns <= FRAME_TIMEOUT_S * 1e9
        ):
            raise
        return newest


def _ended_link(buffer: Buffer, error: TransformException) -> str:
    """Name the link that ended before the others' kept history, or return an empty string."""
    if not isinstance(error, ExtrapolationException) or error.reason != "past":
        return ""
    ended = [
        link
        for link in buffer.links()
        if link.samples and not link.static and link.newest_ns == error.requested_ns
    ]
    if not ended:
        return ""
    assert error.requested_ns is not None
    assert error.newest_ns is not None
    assert error.oldest_ns is not None  # for the error of a time in the past
    gap, kept = error.newest_ns - error.requested_ns, error.newest_ns - error.oldest_ns
    senders = " and ".join(_publishers(ended[0]))
    return (
        f"The last transform of '{ended[0].child_frame}' is {gap / 1e9:.0f} s older than the last "
        f"transform of '{error.child_frame}', of which {kept / 1e9:.0f} s are kept. "
        f"Does {senders or 'its publisher'} still publish '{ended[0].child_frame}'?"
    )


def _publishers(link: Link) -> list[str]:
    """Return the names of a link's senders, without the one of transforms that name none."""
    return sorted({sender.name for sender in link.senders} - {_UNNAMED})


def path_between(
    names: Sequence[str], parents: Sequence[int], target: str, source: str
) -> list[str]:
    """Return the frames from ``source`` up to the common ancestor and down to ``target``.

    Empty if they are not in one tree.
    """
    if target not in names or source not in names:
        return []
    up, down = (_ancestors(names.index(name), parents) for name in (source, target))
    shared = set(down)
    top = next((frame for frame in up if frame in shared), None)
    if top is None:
        return []
    way = up[: up.index(top) + 1] + down[: down.index(top)][::-1]
    return [names[frame] for frame in way]


def _ancestors(frame: int, parents: Sequence[int]) -> list[int]:
    found = []
    while frame >= 0:
        found.append(frame)
        frame = parents[frame]
    return found


def _finite(values: Sequence[float]) -> list[float | None]:
    return [float(value) if math.isfinite(value) else None for value in values]
