"""Numbers and vectors in attributes, by urdfdom's rules: C locale, separated by blanks."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from turtlewire.geometry.quaternions import to_rpy
from turtlewire.urdf.elements import is_of_version
from turtlewire.urdf.model import Pose

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Quaternion
    from turtlewire.urdf.elements import Element
    from turtlewire.urdf.faults import UrdfWarning
    from turtlewire.urdf.model import Vector

__all__ = ["as_number", "color_of", "number_of", "pose_of", "vector_of"]

# What C++ streams read: no "nan", no "inf", no hexadecimal digits, nothing behind the number.
_NUMBER = re.compile(r"[ \t\n\r\f\v]*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


def as_number(text: str) -> float | None:
    """Return the number that ``text`` is, or None: no number, or too large for a double."""
    if _NUMBER.fullmatch(text) is None:
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def number_of(element: Element, attribute: str, refusal: str) -> float | None:
    """Return the number in an attribute; None if the attribute is missing.

    Args:
        element: The element.
        attribute: Name of the attribute.
        refusal: urdfdom's text for an invalid number; ``{}`` in it stands for the text read.

    Raises:
        UrdfError: The attribute is not a number.
    """
    text = element.get(attribute)
    if text is None:
        return None
    value = as_number(text)
    if value is None:
        raise element.error(refusal.format(text))
    return value


def vector_of(element: Element, attribute: str, before: str = "") -> Vector | None:
    """Return the three numbers in an attribute; None if the attribute is missing.

    Args:
        element: The element.
        attribute: Name of the attribute.
        before: What urdfdom writes before the reason.

    Raises:
        UrdfError: The attribute does not hold three numbers.
    """
    text = element.get(attribute)
    if text is None:
        return None
    numbers = _numbers(element, text, "vector", before)
    if len(numbers) != 3:
        reason = (
            f"Parser found {len(numbers)} elements but 3 expected while parsing vector [{text}]"
        )
        raise element.error(before + reason)
    return (numbers[0], numbers[1], numbers[2])


def color_of(
    element: Element, attribute: str, before: str
) -> tuple[float, float, float, float] | None:
    """Red, green, blue and alpha in an attribute; None if the attribute is missing.

    Raises:
        UrdfError: The attribute does not hold four numbers from 0 to 1.
    """
    text = element.get(attribute)
    if text is None:
        return None
    numbers = _numbers(element, text, "color", before)
    if len(numbers) != 4:
        reason = f"Color contains {len(numbers)} elements instead of 4 elements"
        raise element.error(before + reason)
    outside = [number for number in numbers if not 0 <= number <= 1]
    if outside:
        reason = f"Component [{outside[0]:g}] is outside the valid range for colors [0, 1]"
        raise element.error(before + reason)
    return (numbers[0], numbers[1], numbers[2], numbers[3])


def pose_of(element: Element | None, warnings: list[UrdfWarning]) -> Pose:
    """The pose of an ``origin`` element; the identity where the element or an attribute is missing.

    Args:
        element: The element.
        warnings: Gets a quaternion that is ignored, as it came with version 1.1.

    Raises:
        UrdfError: An attribute does not hold its numbers, or there are two rotations.
    """
    if element is None:
        return Pose()
    zero = (0.0, 0.0, 0.0)
    xyz, rpy = vector_of(element, "xyz") or zero, vector_of(element, "rpy")
    if element.get("quat_xyzw") is None or not is_of_version(
        element, 1, "quat_xyzw attribute requiring", warnings
    ):
        return Pose(xyz, rpy or zero)
    if rpy is not None:
        raise element.error(
            "Both rpy and quat_xyzw orientations are defined. Use either one or the other."
        )
    quaternion = _quaternion_of(element)
    return Pose(xyz, to_rpy(quaternion), quaternion)


def _quaternion_of(element: Element) -> Quaternion:
    text = element.get("quat_xyzw") or ""
    numbers = _numbers(element, text, "quaternion", "")
    if len(numbers) != 4:
        raise element.error(
            f"Parser found {len(numbers)} elements but 4 expected while parsing quaternion [{text}]"
        )
    length = math.hypot(*numbers)
    if not 0 < length < math.inf:
        raise element.error(f"The quaternion [{text}] has no direction")
    x, y, z, w = (number / length for number in numbers)
    return x, y, z, w


def _numbers(element: Element, text: str, what: str, before: str) -> list[float]:
    numbers = []
    for piece in filter(None, text.split(" ")):
        value = as_number(piece)
        if value is None:
            where = f"(while parsing a {what} value)"
            raise element.error(f"{before}Unable to parse component [{piece}] to a double {where}")
        numbers.append(value)
    return numbers
