"""OccupancyGrid and its updates: a map as one picture of cells."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.wording import counted
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import finite_pose

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["OccupancyGridDisplay"]

#: More cells in a row or column are drawn coarser: graphics cards draw no larger pictures.
_LARGEST_SIDE = 4096


class OccupancyGridDisplay(Display):
    """A ``nav_msgs/msg/OccupancyGrid``, changed by ``map_msgs/msg/OccupancyGridUpdate``.

    An update sends only its own cells: the header's ``update`` is x, y, width and height in cells
    of the picture. Where several cells of a large map share one of the picture, the most occupied
    counts. The map goes with its frame, as in RViz, unless the option ``use_timestamp`` says that
    it stays where the frame was at its stamp. Other options are the page's.
    """

    kind = "occupancy_grid"
    companions = {"_updates": "map_msgs/msg/OccupancyGridUpdate"}  # noqa: RUF012

    _cells: NDArray[np.int8] | None = None
    _step = 1
    _shown: Content | None = None

    def start(self) -> list[Output]:
        """Return the map again, as far as it is known, if its pose is computed in another way."""
        shown, locked = self._shown, not self.options.flag("use_timestamp")
        if shown is None or self._cells is None or shown.locked == locked:
            return []
        arrays = {"cells": _coarse(self._cells, self._step)}
        self._shown = replace(shown, arrays=arrays, locked=locked)
        return [self._shown]

    def _outputs(self, message: Any) -> list[Output]:
        return [self._update(message) if hasattr(message, "x") else self._whole(message)]

    def _whole(self, message: Any) -> Content:
        info = message.info
        height, width = info.height, info.width
        if not width or not height:
            raise UnusableMessageError(f"the map has no cells: width {width}, height {height}")
        if not 0 < info.resolution < 1e6:
            raise UnusableMessageError(f"a resolution of {info.resolution} m per cell is not valid")
        origin = finite_pose(info.origin, self.warn)
        self._cells = _cells_of(message, width, height).copy()
        self._step = -(-max(width, height) // _LARGEST_SIDE)
        if self._step > 1:
            self.warn(f"{width} x {height} cells, drawn in blocks of {self._step} x {self._step}")
        header = {
            "resolution": float(info.resolution) * self._step,
            "size": [width * float(info.resolution), height * float(info.resolution)],
            "cells": [width, height],
            "origin": origin,
        }
        arrays = {"cells": _coarse(self._cells, self._step)}
        locked = not self.options.flag("use_timestamp")
        place = frame_of(message), stamp_ns_of(message)
        self._shown = Content(header, arrays, *place, locked=locked)
        return self._shown

    def _update(self, message: Any) -> Content:
        if self._cells is None:
            raise UnusableMessageError("an update of a map that has not come yet")
        x, y, width, height = message.x, message.y, message.width, message.height
        if not width or not height:
            raise UnusableMessageError(f"an update of {width} x {height} cells changes nothing")
        rows, columns = self._cells.shape
        if x < 0 or y < 0 or x + width > columns or y + height > rows:
            raise UnusableMessageError(
                f"the update at ({x}, {y}) of {width} x {height} cells does not fit into the map "
                f"of {columns} x {rows}"
            )
        self._cells[y : y + height, x : x + width] = _cells_of(message, width, height)
        step = self._step
        left, low = x // step, y // step
        right, high = -(-(x + width) // step), -(-(y + height) // step)
        block = self._cells[low * step : high * step, left * step : right * step]
        header = {"update": [left, low, right - left, high - low]}
        return Content(header, {"cells": _coarse(block, step)}, event=True)


def _cells_of(message: Any, width: int, height: int) -> NDArray[np.int8]:
    if len(message.data) != width * height:
        raise UnusableMessageError(
            f"{counted(len(message.data), 'cell')} in data, but width {width} and height {height} "
            f"say {width * height}"
        )
    return np.asarray(message.data, dtype=np.int8).reshape(height, width)


def _coarse(cells: NDArray[np.int8], step: int) -> NDArray[np.int8]:
    """Return the greatest value of each block of ``step`` x ``step`` cells; -1 is unknown."""
    if step == 1:
        return np.ascontiguousarray(cells)
    rows = np.maximum.reduceat(cells, np.arange(0, cells.shape[0], step), axis=0)
    return np.maximum.reduceat(rows, np.arange(0, cells.shape[1], step), axis=1)
