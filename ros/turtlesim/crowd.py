"""One tick of very many turtles at once, bit for bit as :meth:`turtlesim.model.Turtle.step` does it one by one. For swarms; with NumPy."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from turtlesim.model import _PI, _TWO_PI, COMMAND_LIFETIME_NS, FIELD_SIZE, PIXELS_PER_METRE, TICK_S

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from turtlesim.model import Pen, Turtle

__all__ = ["Crowd", "CrowdTick"]


class CrowdTick(NamedTuple):
    """What one tick did to a crowd.

    Attributes:
        turtles: Who, in the order of their names.
        poses: Shape (n, 5): x, y [m, y up], heading [rad], speed [m/s], turning rate [rad/s], as
            they are published.
        places: Shape (n, 2): x and y_down [m], not rounded.
        movers: Indices of those that drew a line, ascending, shape (m,).
        lines: Shape (m, 4): x0, y0, x1, y1 in pixels of the 500 x 500 image.
        pens: Shape (m, 4): red, green, blue and width of each line.
        clamped_from: Where a wall stopped a turtle, as ``(x, y_down)`` [m], in order.
    """

    turtles: Sequence[Turtle]
    poses: NDArray[np.float32]
    places: NDArray[np.float64]
    movers: NDArray[np.intp]
    lines: NDArray[np.float64]
    pens: NDArray[np.uint8]
    clamped_from: list[tuple[float, float]]

    def sensor_pixel(self, index: int) -> tuple[int, int]:
        """Column and row that the colour sensor of a turtle looks at."""
        x, y_down = self.places[index].tolist()
        return math.floor(x * PIXELS_PER_METRE + 0.5), math.floor(y_down * PIXELS_PER_METRE + 0.5)

    def stroke_records(self) -> bytes:
        """The lines as :mod:`turtlesim.drawing` packs them."""
        records = np.empty((len(self.lines), 5), dtype="<u4")
        records[:, 0] = self.pens.view(">u4")[:, 0]
        records[:, 1:] = self.lines.astype("<f4").view("<u4")
        return records.tobytes()


class Crowd:
    """Steps turtles together. Their state stays in the turtles themselves."""

    def __init__(self) -> None:
        self._pens: list[Pen] = []
        self._pen_rows = np.empty((0, 4), dtype=np.uint8)

    def step(self, turtles: Sequence[Turtle], now_ns: int) -> CrowdTick:
        """Move turtles, none of which teleports or rotates to a goal (:attr:`Turtle.is_plain`), by one tick."""
        _take_commands(turtles, now_ns)
        theta, forward, lateral, turning, old_x, old_y = _state(turtles)
        theta = theta + turning * TICK_S
        theta = theta - _TWO_PI * np.floor((theta + _PI) / _TWO_PI)
        headings = theta.tolist()
        cos = np.array(
            [*map(math.cos, headings)]
        )  # not NumPy's: its last bits differ from those of the C library
        sin = np.array([*map(math.sin, headings)])
        x = old_x + (cos * forward * TICK_S - sin * lateral * TICK_S)
        y = old_y - (cos * lateral * TICK_S + sin * forward * TICK_S)
        clamped_from = _clamp(x, y)
        for turtle, *turtle_state in zip(turtles, x.tolist(), y.tolist(), headings, strict=True):
            turtle.x, turtle.y_down, turtle.theta = turtle_state
        poses = np.stack(
            (x, FIELD_SIZE - y, theta, np.sqrt(forward * forward + lateral * lateral), turning),
            axis=1,
        ).astype(np.float32)
        drew = ((x != old_x) | (y != old_y)) & np.fromiter(
            (turtle.pen_on for turtle in turtles), bool, len(turtles)
        )
        lines = np.stack((old_x, old_y, x, y), axis=1)[drew] * PIXELS_PER_METRE
        pens = self._rows_of([turtle.pen for turtle in turtles])[drew]
        return CrowdTick(
            turtles,
            poses,
            np.stack((x, y), axis=1),
            np.flatnonzero(drew),
            lines,
            pens,
            clamped_from,
        )

    def _rows_of(self, pens: list[Pen]) -> NDArray[np.uint8]:
        if pens != self._pens:
            self._pens, self._pen_rows = pens, np.array(pens, dtype=np.uint8).reshape(-1, 4)
        return self._pen_rows


def _take_commands(turtles: Sequence[Turtle], now_ns: int) -> None:
    """Note when commands came, and forget those that are too old."""
    for turtle in turtles:
        if turtle._command_is_fresh:
            turtle._command_ns = now_ns
            turtle._command_is_fresh = False
        elif now_ns - turtle._command_ns > COMMAND_LIFETIME_NS:
            turtle._stop()


def _state(turtles: Sequence[Turtle]) -> Sequence[NDArray[np.float64]]:
    """Heading, three commanded velocities and place, an array each."""
    rows: Sequence[NDArray[np.float64]]
    rows = np.array(
        [(t.theta, t.forward, t.lateral, t.turning, t.x, t.y_down) for t in turtles],
        dtype=np.float64,
    ).T.copy()
    return rows


def _clamp(x: NDArray[np.float64], y: NDArray[np.float64]) -> list[tuple[float, float]]:
    """Bring those outside of the field back to its edge, in place; where they had been."""
    outside = np.flatnonzero(~((0.0 <= x) & (x <= FIELD_SIZE) & (0.0 <= y) & (y <= FIELD_SIZE)))  # noqa: SIM300 - as the range reads
    before = [(float(x[k]), float(y[k])) for k in outside]
    for k, (outer_x, outer_y) in zip(outside, before, strict=True):
        x[k] = min(max(outer_x, 0.0), FIELD_SIZE)
        y[k] = min(max(outer_y, 0.0), FIELD_SIZE)
    return before
