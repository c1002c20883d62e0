"""Arrays that callers pass: checked, and converted to what the loops read and write."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.tf import datetimes
from turtlewire.tf.plain.checks import LIMIT, nanoseconds

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


def times_of(stamps: int | ArrayLike) -> tuple[list[int], bool]:
    """Return the stamps, and whether a single one was given instead of an array."""
    import numpy as np

    if isinstance(stamps, (int, np.integer, np.datetime64)) or hasattr(stamps, "to_datetime64"):
        return nanoseconds(stamps=stamps), True
    return stamp_list(stamps), False


def stamp_list(stamps: ArrayLike) -> list[int]:
    """The stamps of a one-dimensional array of integers or ``datetime64``, in nanoseconds."""
    import numpy as np

    array = np.asarray(stamps)
    if array.ndim != 1:
        raise ValueError("stamps must be one-dimensional")
    if array.dtype.kind == "M":
        return [int(stamp) for stamp in datetimes.nanoseconds_array(array)]
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError("stamps must be integers (nanoseconds)")
    times = [int(stamp) for stamp in array]
    if max(times, default=0) >= LIMIT:
        raise OverflowError("stamps do not fit into 64 bits (int64 nanoseconds)")
    return times


def check_status(status: NDArray[np.uint8] | None, count: int) -> None:
    """Raise TypeError or ValueError unless ``status`` is None or takes ``count`` values."""
    import numpy as np

    if status is not None and not (
        isinstance(status, np.ndarray) and status.dtype == np.uint8 and status.flags.carray
    ):
        raise TypeError("status must be a writable, C-contiguous uint8 array")
    check_shape(status, (count,), "status")


def check_shape(array: NDArray[Any] | None, shape: tuple[int, ...], name: str) -> None:
    """Raise ValueError unless the array is None or has this shape."""
    if array is not None and array.shape != shape:
        wanted, given = (", ".join(map(str, sizes)) for sizes in (shape, array.shape))
        raise ValueError(f"{name} must have the shape ({wanted}), not ({given})")


def output_array(out: NDArray[np.float64] | None, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return the caller's ``out``, checked, or a new array of this shape."""
    import numpy as np

    if out is None:
        return np.empty(shape)
    if (
        not isinstance(out, np.ndarray)
        or out.dtype != np.float64
        or not out.flags.c_contiguous
        or not out.flags.writeable
    ):
        raise TypeError("out must be a writable, C-contiguous float64 array")
    check_shape(out, shape, "out")
    return out


def point_arrays(points: ArrayLike, out: NDArray[Any] | None) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the points to read, as float32 or float64, and the array to write to."""
    import numpy as np

    given = np.asarray(points)
    given = np.ascontiguousarray(
        given, dtype=np.float32 if given.dtype == np.float32 else np.float64
    )
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError("points must have the shape (N, 3)")
    if out is None:
        return given, np.empty_like(given)
    if (
        not isinstance(out, np.ndarray)
        or out.dtype != given.dtype
        or not out.flags.c_contiguous
        or not out.flags.writeable
    ):
        raise TypeError(
            "out must be a writable, C-contiguous (N, 3) array of the same type as points"
        )
    check_shape(out, given.shape, "out")
    return (given.copy() if np.may_share_memory(given, out) else given), out
