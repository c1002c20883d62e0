"""PointCloud2: points with colours, at most as many as the page can bear."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.view.displays.cloud_layout import picked_points
from turtlewire.view.displays.coloring import flat, rainbow, ramp
from turtlewire.view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire.view.displays.numeric import anchored, rows_within

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["PointCloudDisplay"]


class PointCloudDisplay(Display):
    """The points of a ``sensor_msgs/msg/PointCloud2``.

    Options: ``color`` (``auto``, ``rgb``, ``intensity``, ``axis``, ``flat``); ``channel`` names the
    field of ``intensity``; ``rainbow`` (default true), ``min_color`` and ``max_color`` without it;
    ``axis`` (``z``, ``x``, ``y``); ``flat_color``. ``auto`` takes colours if there are some, then
    the field ``intensity``, then z.
    """

    kind = "point_cloud"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        points = picked_points(message, self.budget, self.warn)
        count = message.width * message.height
        xyz = np.stack([points[name].astype(np.float64) for name in "xyz"], axis=1)
        finite = rows_within(xyz)
        if len(points) and not finite.any():
            raise UnusableMessageError(f"none of the {count} points is finite")
        points, xyz = points[finite], xyz[finite]
        positions, anchor = anchored(xyz)
        header = {"count": count, "shown": len(points)}
        arrays: dict[str, NDArray[Any]] = {"points": positions}
        arrays["rgba"] = self._colors(points, xyz)
        return [Content(header, arrays, frame_of(message), stamp_ns_of(message), anchor=anchor)]

    def _colors(self, points: NDArray[np.void], xyz: NDArray[np.float64]) -> NDArray[np.uint8]:
        names = points.dtype.names or ()
        way = self.options.choice("color", ("auto", "rgb", "intensity", "axis", "flat"))
        channel = self.options.text("channel", "intensity")
        packed = next((name for name in ("rgb", "rgba") if name in names), None)
        if way in {"auto", "rgb"} and packed is not None and points.dtype[packed].itemsize == 4:
            return _packed_colors(points[packed], with_alpha=packed == "rgba")
        if way in {"auto", "intensity"} and channel in names:
            return self._by_value(points[channel])
        if way == "flat":
            return flat(len(points), self.options.color("flat_color", (255, 255, 255)))
        if way in {"rgb", "intensity"}:
            missing = "rgb or rgba of 4 bytes" if way == "rgb" else channel
            self.warn(f"no field {missing}: coloured by z; the cloud's fields: {', '.join(names)}")
        return self._by_value(xyz[:, "xyz".index(self.options.choice("axis", ("z", "x", "y")))])

    def _by_value(self, values: NDArray[Any]) -> NDArray[np.uint8]:
        chosen = rainbow if self.options.flag("rainbow", True) else ramp
        return chosen(values, self.options)


def _packed_colors(values: NDArray[Any], *, with_alpha: bool) -> NDArray[np.uint8]:
    """Colours packed as 0xAARRGGBB into four bytes, often declared as a float."""
    bits = np.ascontiguousarray(values).view(values.dtype.str[0] + "u4").astype(np.uint32)
    alpha = bits >> 24 if with_alpha else np.full_like(bits, 255)
    channels = [bits >> 16 & 255, bits >> 8 & 255, bits & 255, alpha]
    return np.stack(channels, axis=1).astype(np.uint8)
