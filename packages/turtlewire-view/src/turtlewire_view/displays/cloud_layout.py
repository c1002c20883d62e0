"""The points of a PointCloud2 as a view of its bytes, for any fields and padding."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire_view.displays.content import UnusableMessageError
from turtlewire_view.displays.numeric import spread

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from numpy.typing import NDArray

__all__ = ["picked_points"]

#: PointField's datatypes in order, from 1.
_TYPES = ("", "i1", "u1", "i2", "u2", "i4", "u4", "f4", "f8")
#: NumPy's limit of a record's size, in bytes.
_LARGEST_STEP = 2**31 - 1


def picked_points(message: Any, budget: int, warn: Callable[[str], None]) -> NDArray[np.void]:
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
