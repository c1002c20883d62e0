"""PointCloud2: points with colours, at most as many as the page can draw."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire_view.displays.content import (
    Content,
    Placed,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import anchored, picked_rows, rows_within, spread
from turtlewire_view.displays.points import PointsDisplay, by_axis, by_value, flat, moved

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["OldPointCloudDisplay", "PointCloudDisplay"]


class PointCloudDisplay(PointsDisplay):
    """The points of a ``sensor_msgs/msg/PointCloud2``.

    Options: ``color`` (``auto``, ``rgb``, ``rgbf32``, ``intensity``, ``axis``, ``flat``);
    ``channel`` names the field of ``intensity``; the options of
    :mod:`turtlewire_view.displays.points`; ``axis_in_fixed_frame``, or else the axis is one of
    the message's frame; ``flat_color``. ``auto`` takes colours if there are some, then the field
    ``intensity``, then the axis.
    """

    kind = "point_cloud"

    def points(self, message: Any, budget: int, part: str, header: dict[str, Any]) -> Content:
        """Return the cloud's points that are finite."""
        points, count = self._picked(message, budget)
        xyz = np.stack([points[name].astype(np.float64) for name in "xyz"], axis=1)
        finite = rows_within(xyz)
        if len(points) and not finite.any():
            raise UnusableMessageError("no point is finite")
        points, xyz = points[finite], xyz[finite]
        positions, anchor = anchored(xyz)
        header = {**header, "count": count, "shown": len(points)}
        colors = self._colors(points)
        placed = None
        if colors is None:
            colors = by_axis(xyz, self.options)
            if self.options.flag("axis_in_fixed_frame"):
                placed = Placed(lambda matrices: {"rgba": self._by_fixed_axis(matrices, xyz)})
        arrays: dict[str, NDArray[Any]] = {"points": positions, "rgba": colors}
        frame_id, stamp_ns = frame_of(message), stamp_ns_of(message)
        return Content(header, arrays, frame_id, stamp_ns, part, anchor, placed=placed)

    def _picked(self, message: Any, budget: int) -> tuple[NDArray[np.void], int]:
        """Return at most ``budget`` points as records, and how many points there are."""
        count = message.width * message.height
        return _picked_points(message, budget, self.warn), count

    def _by_fixed_axis(
        self, matrices: NDArray[np.float64], xyz: NDArray[np.float64]
    ) -> NDArray[np.uint8]:
        return by_axis(moved(matrices, xyz), self.options)

    def _colors(self, points: NDArray[np.void]) -> NDArray[np.uint8] | None:
        """Return the colours, or None for the axis's."""
        names = points.dtype.names or ()
        way = self.options.text("color")
        channel = self.options.text("channel") if "channel" in self.options else ""
        packed = next((name for name in ("rgb", "rgba") if name in names), None)
        if packed is not None and points.dtype[packed].itemsize != 4:
            packed = None
        if way in {"auto", "rgb"} and packed is not None:
            return _packed_colors(points[packed], with_alpha=packed == "rgba")
        if way == "rgbf32" and {"r", "g", "b"} <= set(names):
            return _single_colors(points)
        if way in {"auto", "intensity"} and channel in names:
            return by_value(points[channel], self.options)
        if way == "flat":
            return flat(len(points), self.options.color("flat_color"))
        if way in {"rgb", "rgbf32", "intensity"}:
            missing = {"rgb": "rgb or rgba of 4 bytes", "rgbf32": "r, g, b"}.get(way, channel)
            self.warn(
                f"no field {missing}: coloured by {self.options.text('axis')}; the cloud's "
                f"fields: {', '.join(names)}"
            )
        return None


class OldPointCloudDisplay(PointCloudDisplay):
    """The points of a ``sensor_msgs/msg/PointCloud``, which PointCloud2 has replaced."""

    def _picked(self, message: Any, budget: int) -> tuple[NDArray[np.void], int]:
        count = len(message.points)
        picked = spread(count, budget)
        columns = dict(zip("xyz", picked_rows(message.points, picked, "xyz").T, strict=True))
        for channel in message.channels:
            if len(channel.values) == count and channel.name and channel.name not in columns:
                columns[channel.name] = np.array(channel.values, np.float32)[picked]
            else:
                self.warn(
                    f"the channel {channel.name!r} is left out: {len(channel.values)} values for "
                    f"{count} points"
                )
        points = np.zeros(len(picked), [(name, "f4") for name in columns])
        for name, column in columns.items():
            points[name] = column
        return points, count


def _packed_colors(values: NDArray[Any], *, with_alpha: bool) -> NDArray[np.uint8]:
    """Colours packed as 0xAARRGGBB into four bytes, often declared as a float."""
    bits = np.ascontiguousarray(values).view(values.dtype.str[0] + "u4").astype(np.uint32)
    alpha = bits >> 24 if with_alpha else np.full_like(bits, 255)
    channels = [bits >> 16 & 255, bits >> 8 & 255, bits & 255, alpha]
    return np.stack(channels, axis=1).astype(np.uint8)


def _single_colors(points: NDArray[np.void]) -> NDArray[np.uint8]:
    """Colours of the fields r, g and b, from 0 to 1."""
    rgb = np.stack([points[name].astype(np.float64) for name in "rgb"], axis=1)
    rgba = np.full((len(points), 4), 255, dtype=np.uint8)
    rgba[:, :3] = np.rint(255 * np.clip(np.nan_to_num(rgb, nan=0.0), 0.0, 1.0))
    return rgba


#: PointField's datatypes in order, from 1.
_TYPES = ("", "i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")
#: NumPy's limit of a record's size, in bytes.
_LARGEST_STEP = 2**31 - 1


def _picked_points(message: Any, budget: int, warn: Callable[[str], None]) -> NDArray[np.void]:
    """Return at most ``budget`` points of the cloud, evenly chosen, one record each.

    Args:
        message: A PointCloud2.
        budget: How many points are wanted.
        warn: Gets a line about fields that cannot be read and bytes that are missing.

    Raises:
        UnusableMessageError: No point can be read.
    """
    layout = _layout(message, warn)
    rows, columns = _size(message, warn)
    count = rows * columns
    data = np.frombuffer(message.data, np.uint8) if len(message.data) else np.empty(0, np.uint8)
    if not count:
        return np.empty(0, layout)
    cloud: NDArray[np.void] = np.ndarray(
        (rows, columns),
        layout,
        data.data,
        strides=(message.row_step if rows > 1 else 0, message.point_step),
    )
    picked = spread(count, budget)
    return cloud[picked // columns, picked % columns]


def _layout(message: Any, warn: Callable[[str], None]) -> np.dtype[np.void]:
    """Return the record of one point; a field with several elements counts as its first one."""
    step = message.point_step
    if step > _LARGEST_STEP:
        raise UnusableMessageError(f"a point_step of {step} bytes is too large")
    order = ">" if message.is_bigendian else "<"
    fields: dict[str, tuple[str, int]] = {}
    unreadable: dict[str, str] = {}
    for field in message.fields:
        code = _TYPES[field.datatype] if 0 < field.datatype < len(_TYPES) else ""
        place = f"field '{field.name}' at {field.offset}"
        if not code:
            unreadable[field.name] = f"{place} has the unknown datatype {field.datatype}"
        elif field.offset + int(code[1]) > step:
            unreadable[field.name] = f"{place} lies outside the point of {step} bytes"
        elif field.name not in fields:
            fields[field.name] = (order + code, field.offset)
    _require_places(message, fields, unreadable)
    for problem in unreadable.values():
        warn(problem)
    return np.dtype(
        {
            "names": list(fields),
            "formats": [code for code, _ in fields.values()],
            "offsets": [offset for _, offset in fields.values()],
            "itemsize": step,
        }
    )


def _require_places(message: Any, fields: Collection[str], unreadable: Mapping[str, str]) -> None:
    """Raise UnusableMessageError with the reason why x, y or z cannot be read."""
    missing = [name for name in "xyz" if name not in fields]
    for name in missing:
        if name in unreadable:
            raise UnusableMessageError(unreadable[name])
    if missing:
        raise UnusableMessageError(
            f"the cloud has no field {', '.join(missing)} for positions; its fields: "
            f"{', '.join(field.name for field in message.fields) or 'none'}"
        )


def _size(message: Any, warn: Callable[[str], None]) -> tuple[int, int]:
    """Rows and columns whose bytes are there."""
    width, height, step = message.width, message.height, message.point_step
    if not width or not height:
        return 0, 0
    row_step = message.row_step
    if height > 1 and row_step < width * step:
        raise UnusableMessageError(
            f"row_step is {row_step}, but a row of {width} points of {step} bytes needs more"
        )
    available = len(message.data)
    needed = (height - 1) * row_step + width * step
    if available >= needed:
        return height, width
    warn(
        f"the cloud says {width} x {height} points of {step} bytes, which are {needed} bytes, "
        f"and holds {available}"
    )
    if available < width * step:
        return 1, available // step
    return 1 + (available - width * step) // row_step if height > 1 else 1, width
