"""Polygons, points, cells, ranges and the fields of view of cameras."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import count
from typing import Any

import numpy as np

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import LARGEST, anchored, points_of, rows_within

__all__ = [
    "CameraInfoDisplay",
    "GridCellsDisplay",
    "PointDisplay",
    "PolygonDisplay",
    "RangeDisplay",
]


class PolygonDisplay(Display):
    """The outline of a ``geometry_msgs/msg/PolygonStamped``."""

    kind = "polygon"

    def _outputs(self, message: Any) -> list[Output]:
        points = points_of(message.polygon.points[: self.budget])
        finite = rows_within(points)
        if not finite.all():
            self.warn(f"{np.count_nonzero(~finite)} of {len(finite)} corners are not finite")
        if len(points) < len(message.polygon.points):
            self.warn(f"{len(points)} of {len(message.polygon.points)} corners are drawn")
        corners, anchor = anchored(points[finite])
        arrays = {"points": corners}
        header = {"count": len(corners)}
        return [Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)]


class PointDisplay(Display):
    """The last points of a ``geometry_msgs/msg/PointStamped``.

    Options: ``history_length`` (1) is how many stay. Radius and colour are the page's.
    """

    kind = "point"

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._numbers = count()
        self._parts: list[str] = []

    def _outputs(self, message: Any) -> list[Output]:
        at = [float(value) for value in points_of([message.point])[0]]
        if not all(map(math.isfinite, at)):
            point = message.point
            raise UnusableMessageError(f"the point ({point.x}, {point.y}, {point.z}) is not finite")
        frame_id, part = frame_of(message), str(next(self._numbers))
        self._parts.append(part)
        outputs: list[Output] = [Content({"at": at}, {}, frame_id, stamp_ns_of(message), part)]
        while len(self._parts) > self.options.number("history_length"):
            outputs.append(Removal(self._parts.pop(0)))
        return outputs


class GridCellsDisplay(Display):
    """The cells of a ``nav_msgs/msg/GridCells``: rectangles of one size around points."""

    kind = "grid_cells"

    def _outputs(self, message: Any) -> list[Output]:
        size = [float(message.cell_width), float(message.cell_height)]
        if not all(0 < side < LARGEST for side in size):
            raise UnusableMessageError(f"cells of {size[0]} m by {size[1]} m cannot be drawn")
        points = points_of(message.cells[: self.budget])
        finite = rows_within(points)
        if not finite.all():
            self.warn(f"{np.count_nonzero(~finite)} of {len(finite)} cells are not finite")
        if len(points) < len(message.cells):
            self.warn(f"{len(points)} of {len(message.cells)} cells are drawn")
        cells, anchor = anchored(points[finite])
        arrays = {"points": cells}
        return [
            Content({"size": size}, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)
        ]


class CameraInfoDisplay(Display):
    """The field of view of a ``sensor_msgs/msg/CameraInfo``: a pyramid along z.

    The header has ``corners``: where the image's corners are seen at a depth of 1 m.
    """

    kind = "camera_info"

    def _outputs(self, message: Any) -> list[Output]:
        fx, _, cx, _, fy, cy = (float(value) for value in message.k[:6])
        width, height = int(message.width), int(message.height)
        if not (fx and fy and width and height):
            raise UnusableMessageError(
                "the camera is not calibrated: its size or the focal length in k is 0"
            )
        corners = [
            [(x - cx) / fx, (y - cy) / fy]
            for x, y in ((0, 0), (width, 0), (width, height), (0, height))
        ]
        if not all(abs(value) < LARGEST for corner in corners for value in corner):
            raise UnusableMessageError("the numbers in k are not finite")
        return [Content({"corners": corners}, {}, frame_of(message), stamp_ns_of(message))]


class RangeDisplay(Display):
    """The cone of a ``sensor_msgs/msg/Range`` along x: its length and the angle it opens by."""

    kind = "range"

    def _outputs(self, message: Any) -> list[Output]:
        length, angle = float(message.range), float(message.field_of_view)
        if not 0 <= angle < math.pi:
            raise UnusableMessageError(f"a field_of_view of {angle} rad is not a cone")
        if math.isinf(length):
            seen = "nothing in reach" if length > 0 else "an object too near to be measured"
            self.warn(f"the range is {length}: {seen}")
            length = float(message.max_range) if length > 0 else float(message.min_range)
        if not 0 <= length < 1e9:
            raise UnusableMessageError(f"a range of {message.range} m cannot be drawn")
        if not message.min_range <= length <= message.max_range:
            self.warn(
                f"the range {length:g} m is outside min_range {message.min_range:g} and max_range "
                f"{message.max_range:g}"
            )
        header = {"length": length, "angle": angle}
        return [Content(header, {}, frame_of(message), stamp_ns_of(message))]
