"""One tick of many turtles together, bit for bit as :meth:`turtlesim.model.Turtle.step` moves each.

For swarms: with NumPy, a tick costs two thirds of the time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from turtlesim.drawing import shown_pen
from turtlesim.physics import FIELD_SIZE, PIXELS_PER_METRE, clamp, move, pixel_of, published, turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlesim.model import Pen, Turtle


class CrowdTick(NamedTuple):
    """The results of one tick of a crowd.

    Attributes:
        turtles: The turtles, sorted by name.
        poses: Shape (n, 5): x, y [m, y up], heading [rad], speed [m/s], turning rate [rad/s], as
            they are published.
        places: Shape (n, 2): x and y_down [m], not rounded.
        movers: Indices of the turtles that drew a line, ascending, shape (m,).
        lines: Shape (m, 4): x0, y0, x1, y1 in pixels of the 500 x 500 image.
        pens: Shape (m, 4): red, green, blue and width of each line.
        shown_pens: The same as the page shows them.
        clamped_from: Where a wall stopped a turtle, as ``(x, y_down)`` [m], in order.
    """

    turtles: Sequence[Turtle]
    poses: NDArray[np.float32]
    places: NDArray[np.float64]
    movers: NDArray[np.intp]
    lines: NDArray[np.float64]
    pens: NDArray[np.uint8]
    shown_pens: NDArray[np.uint8]
    clamped_from: list[tuple[float, float]]

    def sensor_pixel(self, index: int) -> tuple[int, int]:
        """Column and row that the colour sensor of a turtle looks at."""
        return pixel_of(*self.places[index].tolist())

    def stroke_records(self) -> bytes:
        """Return the lines as :mod:`turtlesim.drawing` packs them."""
        records = np.empty((len(self.lines), 5), dtype="<u4")
        records[:, 0] = self.shown_pens.view(">u4")[:, 0]
        records[:, 1:] = self.lines.astype("<f4").view("<u4")
        return records.tobytes()


class Crowd:
    """Steps turtles together. Their state stays in the turtles themselves."""

    def __init__(self) -> None:
        self._turtles: Sequence[Turtle] = []
        self._pens: list[Pen] = []
        self._pen_rows = self._shown_rows = np.empty((0, 4), dtype=np.uint8)

    def step(self, turtles: Sequence[Turtle], now_ns: int) -> CrowdTick:
        """Move turtles by one tick.

        Args:
            turtles: None of them teleports or rotates to a goal (:attr:`Turtle.is_plain`).
            now_ns: As for :meth:`turtlesim.model.Turtle.step`.
        """
        for turtle in turtles:
            if now_ns > turtle.command_ends_ns:
                turtle.age_command(now_ns)
        old_x, old_y, theta, forward, lateral, turning = _state(turtles)
        theta = turn(theta, turning, np.floor)
        headings = theta.tolist()
        # Of the C library, because NumPy's sine and cosine differ in the last bit.
        cos = np.array([*map(math.cos, headings)])
        sin = np.array([*map(math.sin, headings)])
        x, y = move(old_x, old_y, cos, sin, forward, lateral)
        clamped_from = _clamp(x, y)
        for turtle, *turtle_state in zip(turtles, x.tolist(), y.tolist(), headings, strict=True):
            turtle.x, turtle.y_down, turtle.theta = turtle_state
        state = (x, y, theta, forward, lateral, turning)
        poses = np.stack(published(state, np.sqrt), axis=1).astype(np.float32)
        drew = ((x != old_x) | (y != old_y)) & np.fromiter(
            (turtle.pen_on for turtle in turtles), bool, len(turtles)
        )
        lines = np.stack((old_x, old_y, x, y), axis=1)[drew] * PIXELS_PER_METRE
        self._keep_pens(turtles)
        return CrowdTick(
            turtles,
            poses,
            np.stack((x, y), axis=1),
            np.flatnonzero(drew),
            lines,
            self._pen_rows[drew],
            self._shown_rows[drew],
            clamped_from,
        )

    def _keep_pens(self, turtles: Sequence[Turtle]) -> None:
        # Pens change rarely: the arrays of the last tick mostly serve again.
        pens = [turtle.pen for turtle in turtles]
        if pens == self._pens and turtles is self._turtles:
            return
        self._turtles, self._pens = turtles, pens
        self._pen_rows = np.array(pens, dtype=np.uint8).reshape(-1, 4)
        shown = [shown_pen(turtle.name, turtle.pen) for turtle in turtles]
        self._shown_rows = np.array(shown, dtype=np.uint8).reshape(-1, 4)


def _state(turtles: Sequence[Turtle]) -> Sequence[NDArray[np.float64]]:
    """Place (x, y_down), heading and three commanded velocities, an array each."""
    rows: Sequence[NDArray[np.float64]]
    rows = np.array(
        [(t.x, t.y_down, t.theta, t.forward, t.lateral, t.turning) for t in turtles],
        dtype=np.float64,
    ).T.copy()
    return rows


def _clamp(x: NDArray[np.float64], y: NDArray[np.float64]) -> list[tuple[float, float]]:
    """Bring the turtles outside of the field back to its edge, in place; where they had been."""
    is_inside = (x >= 0.0) & (x <= FIELD_SIZE) & (y >= 0.0) & (y <= FIELD_SIZE)
    outside = np.flatnonzero(~is_inside)
    before = [(float(x[k]), float(y[k])) for k in outside]
    for k, place in zip(outside, before, strict=True):
        x[k], y[k] = clamp(*place)
    return before
