"""Images with the scene drawn over them, and the intrinsics of their cameras."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from typing import Any, NamedTuple

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Status,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.image import CompressedImageDisplay, ImageDisplay
from turtlewire_view.displays.numeric import LARGEST

__all__ = [
    "CAMERA_INFO",
    "CameraDisplay",
    "CompressedCameraDisplay",
    "Intrinsics",
    "info_topic",
    "intrinsics_of",
    "projection_of",
]

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


class _ThroughCamera(Display):
    """An image, with the projection of the CameraInfo next to it.

    The content lies in the frame of the image; its header has ``projection``: ``fx``, ``fy``,
    ``cx``, ``cy``, ``width`` and ``height`` in pixels, ``tx`` and ``ty`` in metres.
    """

    kind = "camera"
    _info: Any = None
    _image: Any = None

    @classmethod
    def suits(cls, topic: str, names: Collection[str]) -> bool:
        """Return True if there is a CameraInfo next to the image."""
        return info_topic(topic) in names

    def topics(self, type_name: str) -> dict[str, str]:
        """Return the topics of the image and of its CameraInfo."""
        return {self.topic: type_name, info_topic(self.topic): CAMERA_INFO}

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the image when it has come and when its CameraInfo has changed."""
        if topic == self.topic:
            self._image = message
        elif _has_same_numbers(message, self._info):
            return []
        else:
            self._info = message
        if self._info is None:
            text = f"No CameraInfo received on [{info_topic(self.topic)}]"
            return [Status.of("warn", text)]
        if self._image is None:
            return []
        return self.content(self._image)

    def _outputs(self, message: Any) -> list[Output]:
        projection = projection_of(self._info)
        outputs: list[Output] = []
        for output in super()._outputs(message):
            assert isinstance(output, Content)
            size = {name: output.header.get(name, 0) for name in ("width", "height")}
            numbers = {**projection._asdict()}
            for name, there in size.items():
                numbers[name] = numbers[name] or there
            if not (numbers["width"] and numbers["height"]):
                raise UnusableMessageError("the width or height of the CameraInfo is 0")
            header = {**output.header, "projection": numbers}
            frame_id, stamp_ns = frame_of(message), stamp_ns_of(message)
            outputs.append(replace(output, header=header, frame_id=frame_id, stamp_ns=stamp_ns))
        return outputs


class CameraDisplay(_ThroughCamera, ImageDisplay):
    """A ``sensor_msgs/msg/Image`` with the scene over it; options as for images."""

    kind = "camera"


class CompressedCameraDisplay(_ThroughCamera, CompressedImageDisplay):
    """A ``sensor_msgs/msg/CompressedImage`` with the scene over it."""

    kind = "camera"


def _has_same_numbers(info: Any, former: Any) -> bool:
    if former is None:
        return False
    return bool(
        (info.width, info.height) == (former.width, former.height)
        and list(info.p) == list(former.p)
        and list(info.k) == list(former.k)
    )
