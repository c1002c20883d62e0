"""Polygons, points, cells, ranges, fields of view of cameras, and measurements at a sensor.

A measurement is one number (Temperature, RelativeHumidity, FluidPressure, Illuminance), or a linear
and an angular part (TwistStamped, AccelStamped, WrenchStamped).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    Vector,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import LARGEST, anchored, points_of, rows_within
from turtlewire_view.displays.points import by_value

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "CameraInfoDisplay",
    "GridCellsDisplay",
    "MeasurementDisplay",
    "PointDisplay",
    "PolygonDisplay",
    "RangeDisplay",
    "TwistOrWrenchDisplay",
]


def _drawn_points(
    display: Display, sent: Sequence[Any], what: str
) -> tuple[NDArray[np.float32], Vector]:
    """Return the finite points within the budget, and their anchor; warn of the others."""
    points = points_of(sent[: display.budget])
    finite = rows_within(points)
    if not finite.all():
        display.warn(f"{np.count_nonzero(~finite)} of {len(finite)} {what} are not finite")
    if len(points) < len(sent):
        display.warn(f"{len(points)} of {len(sent)} {what} are drawn")
    return anchored(points[finite])


class PolygonDisplay(Display):
    """The outline of a ``geometry_msgs/msg/PolygonStamped``."""

    kind = "polygon"

    def _outputs(self, message: Any) -> list[Output]:
        corners, anchor = _drawn_points(self, message.polygon.points, "corners")
        arrays = {"points": corners}
        header = {"count": len(corners)}
        return [Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)]


class PointDisplay(Display):
    """The last points of a ``geometry_msgs/msg/PointStamped``.

    Options: ``history_length`` (1) is how many stay. Radius and colour are the page's.
    """

    kind = "point"

    def _outputs(self, message: Any) -> list[Output]:
        at = [float(value) for value in points_of([message.point])[0]]
        if not all(map(math.isfinite, at)):
            point = message.point
            raise UnusableMessageError(f"the point ({point.x}, {point.y}, {point.z}) is not finite")
        content = Content({"at": at}, {}, frame_of(message), stamp_ns_of(message))
        return self._keep(content, self.options.number("history_length"))


class GridCellsDisplay(Display):
    """The cells of a ``nav_msgs/msg/GridCells``: rectangles of one size around points."""

    kind = "grid_cells"

    def _outputs(self, message: Any) -> list[Output]:
        size = [float(message.cell_width), float(message.cell_height)]
        if not all(0 < side < LARGEST for side in size):
            raise UnusableMessageError(f"cells of {size[0]} m by {size[1]} m cannot be drawn")
        cells, anchor = _drawn_points(self, message.cells, "cells")
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


class _Quantity(NamedTuple):
    """The text format of a quantity, and RViz's limits of its colours."""

    form: str
    factor: float
    bounds: tuple[float, float]


_QUANTITIES = {
    "temperature": _Quantity("{:.1f} °C", 1.0, (0.0, 100.0)),
    "relative_humidity": _Quantity("{:.0f} %", 100.0, (0.0, 1.0)),
    "fluid_pressure": _Quantity("{:.0f} Pa", 1.0, (98_000.0, 105_000.0)),
    "illuminance": _Quantity("{:.0f} lx", 1.0, (0.0, 1000.0)),
}


class MeasurementDisplay(Display):
    """The number of a message, as a ball with a colour, and as text.

    Options: the colour is one between ``min`` and ``max``, unless ``usual_bounds``, which takes
    RViz's bounds of the quantity; see :mod:`turtlewire_view.displays.points` for the others.
    """

    kind = "measurement"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        field = next(name for name in _QUANTITIES if hasattr(message, name))
        form, factor, bounds = _QUANTITIES[field]
        value = float(getattr(message, field))
        if not math.isfinite(value):
            raise UnusableMessageError(f"the {field} is {value}")
        if not self.options.flag("usual_bounds"):
            bounds = (self.options.number("min"), self.options.number("max"))
        color = by_value(np.array([value]), self.options, bounds)[0].tolist()
        text = form.format(factor * value) if abs(value) < 1e9 else f"{value:g}"
        header = {"text": text, "color": color}
        return [Content(header, {}, frame_of(message), stamp_ns_of(message))]


class TwistOrWrenchDisplay(Display):
    """The vectors of the last messages, at the origin of their frame.

    The header has ``linear`` and ``angular``: velocities [m/s, rad/s], accelerations [m/s², rad/s²]
    or force and torque [N, N m]. Options: ``history_length`` messages are kept; colours and sizes
    are the page's.
    """

    kind = "twist_or_wrench"

    def _outputs(self, message: Any) -> list[Output]:
        header = {}
        for name, vector in zip(("linear", "angular"), _vectors(message), strict=True):
            header[name] = [float(vector.x), float(vector.y), float(vector.z)]
            if not all(math.isfinite(value) and abs(value) < LARGEST for value in header[name]):
                raise UnusableMessageError(f"the vector {header[name]} is not finite")
        content = Content(header, {}, frame_of(message), stamp_ns_of(message))
        return self._keep(content, self.options.number("history_length"))


def _vectors(message: Any) -> tuple[Any, Any]:
    if hasattr(message, "wrench"):
        return message.wrench.force, message.wrench.torque
    moving = message.twist if hasattr(message, "twist") else message.accel
    return moving.linear, moving.angular
