"""Depth images as point clouds, with the colours of another image."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.camera import CAMERA_INFO, info_topic, intrinsics_of
from turtlewire_view.displays.content import Output, Status, UnusableMessageError, stamp_ns_of
from turtlewire_view.displays.image import pixels_of, rgba_of
from turtlewire_view.displays.numeric import LARGEST
from turtlewire_view.displays.options import DisplayOptions
from turtlewire_view.displays.point_cloud import PointCloudDisplay

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.content import Content

__all__ = ["DepthCloudDisplay"]

_IMAGE = "sensor_msgs/msg/Image"
#: Images of each kind that wait for one of the other kind, as RViz's Queue Size.
_MOST_COLORS = 5
#: Images are not made coarser before colours are picked of them.
_ANY_SIDE = 2**31
#: A colour image may be this much wider or narrower than the depth image.
_SAME_SHAPE = 0.02


class DepthCloudDisplay(PointCloudDisplay):
    """The points of a depth image, which the CameraInfo next to it places.

    Options: ``color_topic`` is an image whose pixels colour the points; it sees what the depth
    image sees. The others are as for point clouds; ``auto_size`` and ``auto_size_factor`` are the
    page's. The header has ``pixel``: how wide a point is at a distance of 1 m, in metres.
    """

    kind = "depth_cloud"

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._info: Any = None
        self._depth: Any = None  # waits for a colour image or the CameraInfo
        self._colors_seen: deque[Any] = deque(maxlen=_MOST_COLORS)
        self._pixel = 0.0

    @classmethod
    def suits(cls, topic: str, names: Collection[str]) -> bool:
        """Return True if the topic's name says depth and there is a CameraInfo next to it."""
        return "depth" in topic.lower() and info_topic(topic) in names

    def topics(self, type_name: str) -> dict[str, str]:
        """Return the topics of the depth image, its CameraInfo and the colour image."""
        color = self.options.text("color_topic")
        colors = {color: _IMAGE} if color and color != self.topic else {}
        return colors | {self.topic: type_name, info_topic(self.topic): CAMERA_INFO}

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the points when all messages that they need are there."""
        late: list[Output] = []
        if topic == info_topic(self.topic):
            self._info = message
        elif topic == self.topic:
            late, self._depth = self._late_points(), message
        else:
            self._colors_seen.append(message)
        now = self._next_points()
        return [*late[:-1], *now] if now else late  # with one status, the newest

    def points(self, message: Any, budget: int, part: str, header: dict[str, Any]) -> Content:
        """Return the points of a depth image."""
        content = super().points(message, budget, part, header)
        content.header["pixel"] = self._pixel
        return content

    def _late_points(self) -> list[Output]:
        """Return the points of the image that waits, with the best colours that have come."""
        if self._depth is None or self._missing():
            return []
        return self._points_of_waiting()

    def _next_points(self) -> list[Output]:
        if self._depth is None:
            return []
        if missing := self._missing():
            return [Status.of("warn", missing)]
        return self._points_of_waiting() if self._is_colored(self._depth) else []

    def _points_of_waiting(self) -> list[Output]:
        depth, self._depth = self._depth, None
        return self.content(depth)

    def _missing(self) -> str:
        """Return what has not come yet, in one line; empty if all has."""
        color = self.options.text("color_topic")
        if self._info is None:
            return f"No CameraInfo received on [{info_topic(self.topic)}]"
        if color and not self._colors_seen:
            return f"No image received on [{color}]"
        return ""

    def _is_colored(self, depth: Any) -> bool:
        """Return True if no later image can have better colours."""
        if not self.options.text("color_topic"):
            return True
        return stamp_ns_of(self._colors_seen[-1]) >= stamp_ns_of(depth)

    def _picked(self, message: Any, budget: int) -> tuple[NDArray[np.void], int]:
        """Return at most ``budget`` points as records, and how many pixels have a depth."""
        found = _depth_points(message, self._info, budget)
        self._pixel = found.pixel
        if found.left_out:
            self.warn(f"{found.left_out} of {found.looked_at} depths are negative or not finite")
        elif not len(found.points):
            self.warn("no pixel has a depth")
        columns = list(found.points.T)
        fields = [(name, "f8") for name in "xyz"]
        if self.options.text("color_topic"):
            fields.append(("rgb", "u4"))
            columns.append(self._packed(message, found.rows, found.columns))
        points = np.zeros(len(found.points), fields)
        for (name, _), column in zip(fields, columns, strict=True):
            points[name] = column
        return points, message.width * message.height

    def _packed(
        self, depth: Any, rows: NDArray[np.intp], columns: NDArray[np.intp]
    ) -> NDArray[np.uint32]:
        """Return the colours of pixels of the depth image, as 0xRRGGBB."""
        stamp = stamp_ns_of(depth)
        image = min(self._colors_seen, key=lambda each: abs(stamp_ns_of(each) - stamp))
        try:
            rgba = rgba_of(image, DisplayOptions({}, "image"), _ANY_SIDE)
        except UnusableMessageError as error:
            raise UnusableMessageError(f"the colour image cannot be read: {error}") from error
        ratio = (image.width * depth.height) / (image.height * depth.width)
        if abs(ratio - 1) > _SAME_SHAPE:
            raise UnusableMessageError(
                f"the colour image of {image.width} x {image.height} pixels does not have the "
                f"shape of the depth image, {depth.width} x {depth.height}"
            )
        height, width = rgba.shape[:2]
        picked = rgba[rows * height // depth.height, columns * width // depth.width]
        red, green, blue = (picked[:, channel].astype(np.uint32) for channel in range(3))
        packed: NDArray[np.uint32] = red << 16 | green << 8 | blue
        return packed


#: NumPy's code of a depth, and metres of its unit (REP 118).
_ENCODINGS = {"16UC1": ("u2", 0.001), "mono16": ("u2", 0.001), "32FC1": ("f4", 1.0)}


class _DepthPoints(NamedTuple):
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


def _depth_points(image: Any, info: Any, budget: int) -> _DepthPoints:
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
    return _DepthPoints(points, rows, columns, depths.size, left_out, step / abs(fx))


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
