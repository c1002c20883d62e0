"""LaserScan: the points that the beams hit."""

from __future__ import annotations

from typing import Any

import numpy as np

from turtlewire.view.displays.coloring import flat, rainbow
from turtlewire.view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire.view.displays.numeric import anchored, spread

__all__ = ["LaserScanDisplay"]


class LaserScanDisplay(Display):
    """The hits of a ``sensor_msgs/msg/LaserScan``, with intensities as colours.

    All beams are drawn from where the scanner was at the stamp, the time of the first one.

    Options: ``color`` (``auto``, ``intensity``, ``flat``), ``flat_color``, the rainbow's.
    """

    kind = "laser_scan"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        ranges = np.asarray(message.ranges, dtype=np.float64)
        angles = self._angles(message, len(ranges))
        with np.errstate(invalid="ignore"):
            hits = (
                np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
            )
        index = np.flatnonzero(hits)
        if len(ranges) and not len(index):
            self.warn(
                f"none of the {len(ranges)} ranges lies between range_min {message.range_min:g} "
                f"and range_max {message.range_max:g}"
            )
        index = index[spread(len(index), self.budget)]
        flat_points = [np.cos(angles[index]), np.sin(angles[index]), np.zeros(len(index))]
        points, anchor = anchored(np.stack(flat_points, axis=1) * ranges[index, None])
        arrays = {"points": points, "rgba": self._colors(message, index)}
        header = {"count": len(ranges), "shown": len(index)}
        return [Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)]

    def _angles(self, message: Any, count: int) -> Any:
        start, step = message.angle_min, message.angle_increment
        if not np.isfinite([start, step]).all():
            raise UnusableMessageError(
                f"angle_min {start} and angle_increment {step} must be finite"
            )
        claimed = message.angle_max - start
        if count > 1 and step and np.isfinite(claimed) and abs(claimed / step) + 1.5 < count:
            self.warn(
                f"{count} ranges, but angle_min, angle_max and angle_increment say "
                f"{round(claimed / step) + 1}"
            )
        return start + step * np.arange(count)

    def _colors(self, message: Any, index: Any) -> Any:
        way = self.options.choice("color", ("auto", "intensity", "flat"))
        given = len(message.intensities) == len(message.ranges)
        if way != "flat" and given and len(index):
            return rainbow(np.asarray(message.intensities)[index], self.options)
        if way == "intensity" and not given:
            self.warn(f"{len(message.intensities)} intensities for {len(message.ranges)} ranges")
        return flat(len(index), self.options.color("flat_color", (255, 60, 40)))
