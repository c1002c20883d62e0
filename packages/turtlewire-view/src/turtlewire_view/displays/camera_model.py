"""The intrinsics of a CameraInfo, and the topic where it is published."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from turtlewire_view.displays.content import UnusableMessageError
from turtlewire_view.displays.numeric import LARGEST

__all__ = ["CAMERA_INFO", "Intrinsics", "info_topic", "intrinsics_of", "projection_of"]

CAMERA_INFO = "sensor_msgs/msg/CameraInfo"
#: What image_transport appends to the topic of an image.
_TRANSPORTS = ("/compressed", "/compressedDepth")


class Intrinsics(NamedTuple):
    """Focal lengths and principal point in pixels of an image of the given size.

    Attributes:
        fx: Focal length along the rows.
        fy: Focal length along the columns.
        cx: Column of the principal point.
        cy: Row of the principal point.
        tx: Where the optical centre is in the frame of the image along x [m].
        ty: The same along y [m].
        width: Columns of the image; 0 if the message does not say.
        height: Rows of the image; 0 if the message does not say.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    tx: float
    ty: float
    width: int
    height: int


def info_topic(image_topic: str) -> str:
    """Return the topic of the CameraInfo of an image, as image_transport chooses it."""
    for transport in _TRANSPORTS:
        image_topic = image_topic.removesuffix(transport)
    return image_topic.rpartition("/")[0] + "/camera_info"


def projection_of(info: Any) -> Intrinsics:
    """Return the projection of the rectified image (``p``), as RViz uses it for a camera.

    If ``p`` is all zeros, the result is the projection of the raw image (``k``).

    Raises:
        UnusableMessageError: The camera is not calibrated, or a number is not finite.
    """
    p = [float(value) for value in info.p]
    if not any(p):
        return intrinsics_of(info)
    fx, fy = p[0], p[5]
    _require_focal_lengths("p", fx, fy)
    found = Intrinsics(
        fx, fy, p[2], p[6], -p[3] / fx, -p[7] / fy, int(info.width), int(info.height)
    )
    return _finite("p", found)


def intrinsics_of(info: Any) -> Intrinsics:
    """Return the projection of the raw image (``k``).

    Raises:
        UnusableMessageError: The camera is not calibrated, or a number is not finite.
    """
    fx, _, cx, _, fy, cy = (float(value) for value in info.k[:6])
    _require_focal_lengths("k", fx, fy)
    found = Intrinsics(fx, fy, cx, cy, 0.0, 0.0, int(info.width), int(info.height))
    return _finite("k", found)


def _require_focal_lengths(name: str, fx: float, fy: float) -> None:
    if fx == 0 or fy == 0:
        raise UnusableMessageError(
            f"the camera is not calibrated: a focal length in {name} of the CameraInfo is 0"
        )


def _finite(name: str, found: Intrinsics) -> Intrinsics:
    if not all(math.isfinite(value) and abs(value) < LARGEST for value in found):
        raise UnusableMessageError(
            f"{name} of the CameraInfo holds a number that is not finite or too large"
        )
    return found
