"""Errors for values that are not vectors or quaternions, for both cores.

This module does not import NumPy: it only reads attributes of the values.
"""

from __future__ import annotations

from typing import Any

__all__ = ["numbers_error"]

_WANTED = {
    "translation": "3 numbers (x, y, z in metres)",
    "rotation": "4 numbers (a quaternion x, y, z, w)",
    "point": "3 numbers (x, y, z in metres)",
}
_POSE = 7


def numbers_error(argument: str, values: Any, items: tuple[Any, ...] | None) -> Exception:
    """Return the error for ``values`` that are not the wanted count of numbers.

    Args:
        argument: ``"translation"``, ``"rotation"`` or ``"point"``.
        values: What the caller passed.
        items: Its elements; None if it is not iterable.
    """
    wanted = f"{argument} must have {_WANTED[argument]}"
    if items is None:
        return TypeError(f"{wanted}, not {type(values).__name__}{_for_object(argument, values)}")
    if any(hasattr(item, "__len__") and not isinstance(item, str) for item in items):
        return ValueError(f"{wanted}, not {len(items)} rows{_for_matrix(argument)}")
    for item in items:
        if isinstance(item, str) or not (hasattr(item, "__float__") or hasattr(item, "__index__")):
            return TypeError(f"{wanted}, but {item!r} is of type {type(item).__name__}")
    return ValueError(f"{wanted}, not {len(items)}{_for_count(argument, len(items))}")


def _for_count(argument: str, count: int) -> str:
    if count == _POSE:
        return "; split a pose of 7 numbers into pose[:3] and pose[3:]"
    if argument == "rotation" and count == 3:
        return "; of roll, pitch and yaw, pass geometry.quaternion_from_euler((roll, pitch, yaw))"
    return ""


def _for_matrix(argument: str) -> str:
    if argument == "point":
        return ""
    return f"; of a 4x4 matrix, pass Transform.from_matrix(target, source, matrix).{argument}"


def _for_object(argument: str, value: Any) -> str:
    names = "xyzw" if argument == "rotation" else "xyz"
    if hasattr(value, "translation") and hasattr(value, "rotation"):
        return "; pass its translation and its rotation"
    if all(hasattr(value, name) for name in names):
        return f"; pass ({', '.join(f'v.{name}' for name in names)}) of it"
    if argument == "translation" and hasattr(value, "__index__"):
        return "; static transforms take no stamp before it"
    if argument == "rotation" and value is None:
        return "; leave it out for no rotation"
    return ""
