"""Arrays that callers pass: checked, and converted to what the loops read and write."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from turtlewire.tf.plain.checks import LIMIT, moments

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


def times_of(stamps: int | ArrayLike | None) -> tuple[list[int | None], bool]:
    """Return the stamps, and whether a single one was given instead of an array."""
    import numpy as np

    if stamps is None:
        return [None], True
    if isinstance(stamps, (int, np.integer, np.datetime64)) or hasattr(stamps, "to_datetime64"):
        return moments(stamps=stamps), True
    return [*stamp_list(stamps)], False


def stamp_list(stamps: ArrayLike) -> list[int]:
    """The stamps of a one-dimensional array of integers or ``datetime64``, in nanoseconds."""
    from turtlewire.tf.array_arguments import stamp_array

    times: list[int] = stamp_array(stamps).tolist()
    if -LIMIT in times:
        raise ValueError("a time is NaT (not a time)")
    return times


def check_errors(errors: str, other: str = "nan") -> bool:
    """Return True for the other choice than "raise".

    Raises:
        ValueError: ``errors`` is neither.
    """
    if errors not in ("raise", other):
        raise ValueError(f"errors must be 'raise' or {other!r}, not {errors!r}")
    return errors == other


def check_shape(array: NDArray[Any] | None, shape: tuple[int, ...], name: str) -> None:
    """Raise ValueError unless the array is None or has this shape."""
    if array is not None and array.shape != shape:
        raise ValueError(f"{name} must have the shape {shape}, not {array.shape}")


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

    from turtlewire.tf.array_arguments import point_array

    given = point_array(points)
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
