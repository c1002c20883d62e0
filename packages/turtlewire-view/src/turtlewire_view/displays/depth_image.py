"""The points of a depth image in the frame of its camera."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.camera_model import intrinsics_of
from turtlewire_view.displays.content import UnusableMessageError
from turtlewire_view.displays.encodings import pixels_of
from turtlewire_view.displays.numeric import LARGEST

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["DepthPoints", "depth_points"]

#: NumPy's code of a depth, and metres of its unit (REP 118).
_ENCODINGS = {"16UC1": ("u2", 0.001), "mono16": ("u2", 0.001), "32FC1": ("f4", 1.0)}


class DepthPoints(NamedTuple):
    """Points of a depth image.

    Attributes:
        points: ``(n, 3)``: x to the right, y down, z forward [m].
        rows: Row of each point in the image.
        columns: Column of each point in the image.
        looked_at: How many pixels were looked at.
        left_out: How many of these have a negative or endless depth.
        pixel: How wide a point must be at a distance of 1 m to touch the next one [m].
    """

    points: NDArray[np.float64]
    rows: NDArray[np.intp]
    columns: NDArray[np.intp]
    looked_at: int
    left_out: int
    pixel: float


def depth_points(image: Any, info: Any, budget: int) -> DepthPoints:
    """Return at most ``budget`` points of a depth image, in a regular grid of its pixels.

    Pixels with the depth 0 or NaN were not measured and give no point.

    Args:
        image: An Image, with depths in millimetres (``16UC1``, ``mono16``) or metres (``32FC1``).
        info: The CameraInfo of the image.
        budget: How many points may be sent.

    Raises:
        UnusableMessageError: The encoding is not one of depths, bytes are missing, or the camera is
            not calibrated.
    """
    if image.encoding not in _ENCODINGS:
        raise UnusableMessageError(
            f"the encoding '{image.encoding}' is not supported for depths; choose from "
            f"{', '.join(_ENCODINGS)}"
        )
    fx, fy, cx, cy = _projection(image, info)
    code, unit = _ENCODINGS[image.encoding]
    step = max(1, math.ceil(math.sqrt(image.width * image.height / budget)))
    depths = pixels_of(image, code, 1)[::step, ::step, 0].astype(np.float64) * unit
    measured = (depths != 0) & ~np.isnan(depths)
    usable = measured & (depths > 0) & (depths < LARGEST)
    rows, columns = np.nonzero(usable)
    z = depths[rows, columns]
    rows, columns = rows * step, columns * step
    points = np.stack([(columns - cx) / fx * z, (rows - cy) / fy * z, z], axis=1)
    left_out = int(np.count_nonzero(measured & ~usable))
    return DepthPoints(points, rows, columns, depths.size, left_out, step / abs(fx))


def _projection(image: Any, info: Any) -> tuple[float, float, float, float]:
    """Return fx, fy, cx and cy in pixels of the image.

    The CameraInfo is of the full sensor; the image may be a part of it (``roi``), binned or made
    coarser.
    """
    numbers = intrinsics_of(info)
    roi = info.roi
    seen = (roi.width or numbers.width, roi.height or numbers.height)
    binning = (max(1, info.binning_x), max(1, info.binning_y))
    across, down = (
        size / whole if whole else 1.0 / binned
        for size, whole, binned in zip((image.width, image.height), seen, binning, strict=True)
    )
    found = (
        numbers.fx * across,
        numbers.fy * down,
        (numbers.cx - roi.x_offset) * across,
        (numbers.cy - roi.y_offset) * down,
    )
    if not (found[0] and found[1]):
        raise UnusableMessageError(f"the image has no pixels: {image.width} x {image.height}")
    return found
