"""The arrays of several markers as one, and the rows of each marker in it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from turtlewire_view.displays.marker_shapes import MarkerShape

__all__ = ["packed_shapes"]

_NAMES = ("points", "colors", "file", "uv")


def packed_shapes(
    shapes: Sequence[MarkerShape],
) -> tuple[list[dict[str, Any]], dict[str, NDArray[Any]], tuple[tuple[str, str], ...]]:
    """Return headers with ``[first, count]`` of the rows of each array, the arrays, and packages.

    Args:
        shapes: The markers.
    """
    offsets = dict.fromkeys(_NAMES, 0)
    headers = []
    for shape in shapes:
        ranges = {name: [offsets[name], len(getattr(shape, name))] for name in _NAMES}
        headers.append({**shape.header, **ranges})
        offsets = {name: sum(ranges[name]) for name in _NAMES}
    if not shapes:
        return [], {}, ()
    arrays = {
        "points": np.concatenate([shape.points for shape in shapes]),
        "colors": np.concatenate([shape.colors for shape in shapes]),
        "files": np.concatenate([shape.file for shape in shapes]),
        "uv": np.concatenate([shape.uv for shape in shapes]),
    }
    packages = tuple(sorted({each for shape in shapes for each in shape.packages}))
    return headers, arrays, packages
