"""The camera of a ``.rviz`` file, ``Views/Current``: converts RViz's kinds to the page's two."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, TypedDict

from turtlewire.web.commands import is_finite_number

__all__ = ["Camera", "camera_from", "camera_properties", "is_camera"]

_FIXED_FRAME = "<Fixed Frame>"
#: Kinds of RViz that look at a point; the others are at a position and look around.
_ORBITS = ("Orbit", "XYOrbit", "ThirdPersonFollower")
_TOP = "TopDownOrtho"
_DISTANCE, _ANGLE, _SCALE = 10.0, math.pi / 4, 10.0  # RViz's own defaults
_NEAREST_M, _FARTHEST_M = 1e-3, 1e7


class Camera(TypedDict):
    """The camera of a view.

    Attributes:
        kind: ``orbit``, or ``top`` for a picture from above.
        frame: The frame that the camera moves with; empty for the fixed frame.
        focus: What is in the middle: x, y, z in that frame [m].
        distance: From there to the eye [m].
        yaw: Direction from there to the eye about z [rad].
        pitch: How high the eye is above there [rad].
        scale: Pixels of a metre, from above; None where the file says none.
    """

    kind: str
    frame: str
    focus: list[float]
    distance: float
    yaw: float
    pitch: float
    scale: float | None


def camera_from(views: object) -> Camera | None:
    """Return the camera of the value of ``Views``; None if it has none that the page has, too."""
    current = _mapping(_mapping(views).get("Current"))
    kind = str(current.get("Class") or "").rpartition("/")[2]
    frame = str(current.get("Target Frame") or _FIXED_FRAME)
    camera = Camera(
        kind="orbit",
        frame="" if frame.startswith("<") else frame,
        focus=[0.0, 0.0, 0.0],
        distance=_DISTANCE,
        yaw=_ANGLE,
        pitch=_ANGLE,
        scale=None,
    )
    if kind == _TOP and "Scale" in current:
        x, y, scale = (_number(current, word, 0.0) for word in ("X", "Y", "Scale"))
        camera["kind"], camera["focus"], camera["scale"] = "top", [x, y, 0.0], abs(scale) or _SCALE
        return camera
    if kind not in _ORBITS or "Distance" not in current:
        return None
    point = _mapping(current.get("Focal Point"))
    camera["focus"] = [_number(point, axis, 0.0) for axis in "XYZ"]
    camera["distance"] = _bounded(_number(current, "Distance", _DISTANCE))
    camera["yaw"] = _number(current, "Yaw", _ANGLE)
    camera["pitch"] = _number(current, "Pitch", _ANGLE)
    return camera


def camera_properties(camera: Camera) -> dict[str, Any]:
    """Return the value of ``Current`` in ``Views``."""
    frame = camera["frame"] or _FIXED_FRAME
    properties: dict[str, Any] = {"Name": "Current View", "Target Frame": frame}
    x, y, z = camera["focus"]
    if camera["kind"] == "top":
        top = {"Class": f"rviz_default_plugins/{_TOP}", "Value": f"{_TOP} (rviz_default_plugins)"}
        return properties | top | {"Angle": 0, "Scale": camera["scale"] or _SCALE, "X": x, "Y": y}
    return properties | {
        "Class": "rviz_default_plugins/Orbit",
        "Distance": camera["distance"],
        "Focal Point": {"X": x, "Y": y, "Z": z},
        "Pitch": camera["pitch"],
        "Value": "Orbit (rviz_default_plugins)",
        "Yaw": camera["yaw"],
    }


def is_camera(value: object) -> bool:
    """Return True if a page's answer describes a camera."""
    if not isinstance(value, Mapping) or value.get("kind") not in ("orbit", "top"):
        return False
    focus, scale = value.get("focus"), value.get("scale")
    return (
        isinstance(value.get("frame"), str)
        and isinstance(focus, list)
        and len(focus) == 3
        and all(map(is_finite_number, focus))
        and all(is_finite_number(value.get(word)) for word in ("distance", "yaw", "pitch"))
        and (scale is None or is_finite_number(scale))
    )


def _number(properties: Mapping[str, Any], word: str, default: float) -> float:
    value = properties.get(word, default)
    return float(value) if is_finite_number(value) and abs(value) < _FARTHEST_M else default


def _bounded(distance: float) -> float:
    return min(max(distance, _NEAREST_M), _FARTHEST_M)


def _mapping(value: object) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}
