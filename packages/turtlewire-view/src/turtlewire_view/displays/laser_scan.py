"""LaserScan: the points that the beams hit, each from the scanner's pose at its time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.wording import counted
from turtlewire_view.displays.content import (
    Content,
    Placed,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import LARGEST, spread
from turtlewire_view.displays.points import PointsDisplay, by_axis, by_value, flat, moved

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["LaserScanDisplay"]

#: A scan that takes longer is a wrong message [s].
_LONGEST_SCAN = 60.0


class LaserScanDisplay(PointsDisplay):
    """The hits of a ``sensor_msgs/msg/LaserScan``, with intensities as colours.

    Beam *i* is transformed at its own time, ``stamp + i * time_increment``, as laser_geometry does
    in a moving fixed frame; it takes the transforms at both ends of the scan and what lies between
    on a line, this one takes each beam's.

    Options: ``color`` (``auto``, ``intensity``, ``axis``, ``flat``), and the options of
    :class:`turtlewire_view.displays.point_cloud.PointCloudDisplay`.
    """

    kind = "laser_scan"

    def points(self, message: Any, budget: int, part: str, header: dict[str, Any]) -> Content:
        """Return the hits, in the scanner's frame at the stamp."""
        with np.errstate(invalid="ignore"):  # NumPy warns of signalling NaNs
            ranges = np.asarray(message.ranges, dtype=np.float64)
        angles = self._angles(message, len(ranges))
        index = self._hits(message, ranges)[0]
        index = index[spread(len(index), budget)]
        directions = np.stack(
            [np.cos(angles[index]), np.sin(angles[index]), np.zeros(len(index))], axis=1
        )
        hits = directions * ranges[index, None]
        colors = self._colors(message, index)
        offsets = self._offsets_ns(message, index)
        arrays: dict[str, NDArray[Any]] = {"points": hits.astype(np.float32)}
        arrays["rgba"] = by_axis(hits, self.options) if colors is None else colors
        header = {**header, "count": len(ranges), "shown": len(index)}
        placed = None
        in_fixed = colors is None and self.options.flag("axis_in_fixed_frame")
        if offsets.any() or in_fixed:
            placed = Placed(
                lambda matrices: self._placed(matrices, hits, by_axis=in_fixed),
                stamp_ns_of(message) + offsets if offsets.any() else None,
            )
        frame_id, stamp_ns = frame_of(message), stamp_ns_of(message)
        return Content(header, arrays, frame_id, stamp_ns, part, placed=placed)

    def _placed(
        self, matrices: NDArray[np.float64], hits: NDArray[np.float64], *, by_axis: bool
    ) -> dict[str, NDArray[Any]]:
        """Return the arrays that depend on the scanner's pose at each beam."""
        first, each = matrices[:1], matrices[1:] if len(matrices) > 1 else matrices
        in_fixed = moved(each, hits)
        arrays: dict[str, NDArray[Any]] = {}
        if len(matrices) > 1:
            stamp_from_fixed = np.linalg.inv(first).astype(np.float64)
            at_stamp = moved(stamp_from_fixed, in_fixed)
            arrays["points"] = at_stamp.astype(np.float32)
        if by_axis:
            arrays["rgba"] = self._by_axis(in_fixed)
        return arrays

    def _by_axis(self, places: NDArray[np.float64]) -> NDArray[np.uint8]:
        return by_axis(places, self.options)

    def _hits(self, message: Any, ranges: NDArray[np.float64]) -> tuple[NDArray[np.intp], ...]:
        with np.errstate(invalid="ignore"):
            inside = (ranges >= message.range_min) & (ranges <= message.range_max)
            hits = inside & (ranges < LARGEST)
        if len(ranges) and not hits.any():
            self.warn(
                f"no range lies between range_min {message.range_min:g} "
                f"and range_max {message.range_max:g}"
            )
        return np.nonzero(hits)

    def _angles(self, message: Any, count: int) -> Any:
        start, step = message.angle_min, message.angle_increment
        if not np.isfinite([start, step]).all():
            raise UnusableMessageError(
                f"angle_min {start} and angle_increment {step} must be finite"
            )
        problem = _problem_of_angles(start, step, message.angle_max, count)
        if problem:
            self.warn(problem)
        return start + step * np.arange(count)

    def _offsets_ns(self, message: Any, index: NDArray[np.intp]) -> NDArray[np.int64]:
        """Return each beam's time after the stamp; all 0 for a scan without a stamp."""
        step = float(message.time_increment)
        longest = step * max(1, len(message.ranges))
        if not 0 <= longest <= _LONGEST_SCAN:
            self.warn(
                f"time_increment {step:g} s is not used: {counted(len(message.ranges), 'beam')} "
                f"would take {longest:g} s"
            )
            step = 0.0
        if not stamp_ns_of(message):
            step = 0.0
        offsets: NDArray[np.int64] = np.rint(index * (step * 1e9)).astype(np.int64)
        return offsets

    def _colors(self, message: Any, index: NDArray[np.intp]) -> NDArray[np.uint8] | None:
        """Return the colours, or None for the axis's."""
        way = self.options.text("color")
        given = len(message.intensities) == len(message.ranges)
        if way == "axis":
            return None
        if way != "flat" and given and len(index):
            return by_value(np.asarray(message.intensities)[index], self.options)
        if way == "intensity" and not given:
            ranges = counted(len(message.ranges), "range")
            self.warn(f"{len(message.intensities)} intensities for {ranges}")
        return flat(len(index), self.options.color("flat_color"))


def _problem_of_angles(start: float, step: float, end: float, count: int) -> str:
    """Return the problem of a scan's angles, or an empty string."""
    if count < 2:
        return ""
    if not step:
        return f"angle_increment is 0: all {count} beams are drawn at {start:g} rad"
    if not np.isfinite(end):
        return f"angle_max is {end}: the beams are drawn by angle_min and angle_increment"
    claimed = (end - start) / step
    if claimed < -0.5:
        return (
            f"angle_increment {step:g} leads from angle_min {start:g} away from angle_max {end:g}"
        )
    if claimed + 1.5 < count:
        return (
            f"{count} ranges, but angle_min, angle_max and angle_increment say {round(claimed) + 1}"
        )
    return ""
