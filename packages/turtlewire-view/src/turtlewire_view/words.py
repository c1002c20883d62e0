"""Describes the pose of a frame in another frame in plain words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["transform_in_words"]

_NOTHING_M = 0.005
_NOTHING_DEG = 0.5
_DIRECTIONS = (("ahead", "behind"), ("to the left", "to the right"), ("above", "below"))
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
