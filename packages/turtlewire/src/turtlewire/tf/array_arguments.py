"""Arrays that callers pass, for both cores: stamps and points, checked and converted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from turtlewire.tf.datetimes import nanoseconds_array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

__all__ = ["int64_stamps", "number_array", "point_array", "stamp_array"]


def stamp_array(stamps: ArrayLike) -> NDArray[np.int64]:
    """Return stamps as contiguous int64 nanoseconds, shape (N,).

    Args:
        stamps: Integers of nanoseconds, or ``datetime64``.

    Raises:
        OverflowError: A stamp does not fit into 64 bits.
        TypeError: The stamps are of another type, for example floats.
        ValueError: The shape is another, or a stamp is NaT.
    """
    array = _array(stamps, "stamps")
    if array.dtype.kind not in "iuM" and (array.size or not array.ndim):
        _refuse_stamps(array)
    if array.ndim != 1:
        remedy = ""
        if not array.ndim:
            remedy = "; for a single time, call lookup_transform or set_transform"
        elif array.size == max(array.shape):
            remedy = "; write stamps.ravel()"
        raise ValueError(f"stamps must have the shape (N,), not {array.shape}{remedy}")
    return int64_stamps(array)


def int64_stamps(array: NDArray[Any]) -> NDArray[np.int64]:
    """Return integers or ``datetime64`` (N,) as contiguous int64 nanoseconds.

    Raises:
        OverflowError: A stamp does not fit into 64 bits.
        ValueError: A time is NaT, or does not fit into 64 bits.
    """
    if array.dtype.kind == "M":
        return nanoseconds_array(array)
    if array.dtype.kind == "u" and array.size and array.max() > np.iinfo(np.int64).max:
        raise OverflowError("stamps do not fit into 64 bits (int64 nanoseconds)")
    return np.ascontiguousarray(array, dtype=np.int64)


def _refuse_stamps(array: NDArray[Any]) -> NoReturn:
    kind, given = array.dtype.kind, str(array.dtype)
    remedy = ""
    if kind == "f":
        remedy = "; for seconds, write np.round(seconds * 1e9).astype(np.int64)"
    elif kind in "SU":
        given, remedy = "str", "; write np.array(stamps, dtype='datetime64[ns]')"
    elif kind == "m":
        remedy = "; write stamps.astype('timedelta64[ns]').astype(np.int64)"
    elif kind == "O" and array.size:
        given = type(array.flat[0]).__name__
        if given == "datetime":
            remedy = "; write np.array(stamps, dtype='datetime64[ns]')"
        elif given == "NoneType" and not array.ndim:
            remedy = "; for the latest, call lookup_transform"
    raise TypeError(
        f"stamps must be integers of nanoseconds or numpy.datetime64, not {given}{remedy}"
    )


def point_array(points: ArrayLike) -> NDArray[Any]:
    """Return points as a contiguous array of shape (N, 3): float32 stays, all else is float64.

    Raises:
        ValueError: The shape is another.
    """
    array = number_array(points, "points")
    if array.ndim == 2 and array.shape[1] == 3:
        return array
    remedy = ""
    if array.shape == (3,):
        remedy = "; write [point] for a single one"
    elif array.ndim == 2 and array.shape[0] == 3:
        remedy = "; write points.T"
    elif array.ndim == 2 and array.shape[1] > 3:
        remedy = "; write points[:, :3] if the first columns are x, y, z"
    elif array.ndim > 2 and array.shape[-1] == 3:
        remedy = "; write points.reshape(-1, 3)"
    raise ValueError(f"points must have the shape (N, 3), not {array.shape}{remedy}")


#: What to write instead of a Transform.
_OF_TRANSFORM = {
    "points": "; pass [transform.translation] for its origin, and chain transforms with a @ b",
    "poses": "; write [transform] for a single one",
    "stamps": "; pass [transform.stamp_ns]",
    "matrix": "; pass transform.as_matrix()",
}


def number_array(values: Any, argument: str) -> NDArray[Any]:
    """Return a contiguous array of float64, or of float32 if it is one.

    Raises:
        TypeError: An element is not a number.
        ValueError: The rows have different lengths, or an element is not a number.
    """
    array = _array(values, argument)
    if array.dtype.kind not in "biuf":
        given = type(values).__name__ if not array.ndim else f"an array of {array.dtype}"
        if array.dtype.kind in "SU":
            given = "text"
        elif array.dtype.kind == "O":
            strange = [item for item in array.flat if not hasattr(item, "__float__")]
            if not strange:
                return np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)
            given = type(strange[0]).__name__
        raise TypeError(f"{argument} must be an array of numbers, not {given}")
    kept = np.float32 if array.dtype == np.float32 else np.float64
    # ascontiguousarray makes a scalar an array.
    return np.ascontiguousarray(array, dtype=kept).reshape(array.shape)


def _array(values: Any, argument: str) -> NDArray[Any]:
    if hasattr(values, "translation") and hasattr(values, "rotation"):  # NumPy makes it 7 numbers
        given = type(values).__name__
        raise TypeError(
            f"{argument} must be an array, not {given}{_OF_TRANSFORM.get(argument, '')}"
        )
    try:
        return np.asarray(values)
    except ValueError as error:
        if "inhomogeneous" not in str(error):
            raise
        raise ValueError(f"{argument} must be one array, not rows of different lengths") from None
