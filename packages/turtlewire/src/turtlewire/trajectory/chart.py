"""Charts as SVG text: panels with axes, lines, bands and boxes. Needs no display and no package."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.call_errors import hint_at
from turtlewire.new_file import new_file
from turtlewire.terminal.printable import printable
from turtlewire.tf import svg
from turtlewire.tf.drawing import text_width

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]

__all__ = ["COLOURS", "GREY", "Panel", "Plot", "colour_of", "page"]

#: Of the first trajectory, the second …; they differ for readers who are colour blind, too.
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
GREY = "#444444"
_GRID, _TEXT = "#e4e4e4", "#333333"
#: From small errors to large ones: dark blue, teal, green, yellow, red.
_SCALE = np.array(
    [(48, 18, 120), (33, 113, 181), (40, 160, 120), (240, 200, 40), (215, 48, 31)], np.float64
)
_SIZE = 11
_LEFT, _RIGHT, _TOP, _BOTTOM = 62.0, 14.0, 26.0, 40.0
#: A line of more points is thinned: no screen shows more.
_MOST_POINTS = 4000


@hint_at({"show savefig write to_file": "save(path); notebooks show it by themselves"})
@dataclass(frozen=True)
class Plot:
    """A picture; notebooks show it, `save` writes it.

    Attributes:
        svg: The SVG document.
    """

    svg: str

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write an ``.svg``, ``.pdf`` or ``.png`` file.

        Raises:
            ModuleNotFoundError: PNG is asked for, and pypdfium2 is not installed.
            ValueError: The name ends otherwise.
        """
        from turtlewire.trajectory.pictures import pdf_of, png_of

        writers: dict[str, Callable[[str], bytes]] = {
            ".svg": str.encode,
            ".pdf": pdf_of,
            ".png": png_of,
        }
        writer = writers.get(os.path.splitext(path)[1].lower())
        if writer is None:
            raise ValueError(
                f"{os.fspath(path)} does not end in .svg, .pdf or .png: plots are written as these"
            )
        data = writer(self.svg)
        with new_file(path) as unfinished, open(unfinished, "wb") as file:
            file.write(data)

    def _repr_svg_(self) -> str:
        return self.svg


def page(panels: Sequence[Panel], width: float, legend: Iterable[tuple[str, str]] = ()) -> Plot:
    """Panels and, below them, a legend of names with their colours, as one picture."""
    height = max(panel.bottom for panel in panels)
    parts = [part for panel in panels for part in panel.parts()]
    x, y = _LEFT, height + 14
    for name, colour in legend:
        shown = printable(name)
        needed = 34 + text_width(shown, _SIZE)
        if x > _LEFT and x + needed > width:
            x, y = _LEFT, y + 18
        parts.append(svg.line(x, y, x + 18, y, colour, 3))
        parts.append(_text(x + 24, y + 4, shown))
        x += needed + 12
        height = y + 14
    ground = f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>'
    return Plot(svg.document(width, height, [ground, *parts]))


def colour_of(share: float) -> str:
    """Return a colour for a number from 0 (dark blue) to 1 (red)."""
    place = min(max(share, 0.0), 1.0) * (len(_SCALE) - 1)
    first = min(int(place), len(_SCALE) - 2)
    mixed = _SCALE[first] + (place - first) * (_SCALE[first + 1] - _SCALE[first])
    return "#{:02x}{:02x}{:02x}".format(*(round(part) for part in mixed))


class Panel:
    """Axes and what is drawn in them.

    Args:
        left: Where the panel begins on the page, in pixels.
        top: Likewise, downwards.
        width: Of the panel with its labels.
        height: Likewise.
        x_range: Smallest and largest number of the horizontal axis.
        y_range: Likewise, of the vertical one.
        labels: Of the horizontal and of the vertical axis.
        title: Above the axes.
        equal: Whether a metre is as long on both axes.
        x_names: Names instead of numbers along the horizontal axis, at 0, 1, 2 …
    """

    def __init__(
        self,
        place: tuple[float, float, float, float],
        x_range: tuple[float, float],
        y_range: tuple[float, float],
        labels: tuple[str, str],
        *,
        title: str = "",
        equal: bool = False,
        x_names: Sequence[str] = (),
    ) -> None:
        left, top, width, height = place
        self._box = (left + _LEFT, top + _TOP, width - _LEFT - _RIGHT, height - _TOP - _BOTTOM)
        self.bottom = top + height
        self._x, self._y = _widened(*x_range), _widened(*y_range)
        if equal:
            self._make_equal()
        self._parts: list[str] = []
        self._front: list[str] = []
        self._draw_axes(labels, title, x_names)

    def _make_equal(self) -> None:
        _, _, width, height = self._box
        per_pixel = max((self._x[1] - self._x[0]) / width, (self._y[1] - self._y[0]) / height)

        def around(ends: tuple[float, float], pixels: float) -> tuple[float, float]:
            middle, half = (ends[0] + ends[1]) / 2, per_pixel * pixels / 2
            return middle - half, middle + half

        self._x, self._y = around(self._x, width), around(self._y, height)

    def parts(self) -> list[str]:
        """Return the elements of the SVG document."""
        return [*self._parts, *self._front]

    def x(self, number: float) -> float:
        """Return the page coordinate of a number on the horizontal axis."""
        left, _, width, _ = self._box
        return left + width * (number - self._x[0]) / (self._x[1] - self._x[0])

    def y(self, number: float) -> float:
        """Return the page coordinate of a number on the vertical axis."""
        _, top, _, height = self._box
        return top + height * (self._y[1] - number) / (self._y[1] - self._y[0])

    def line(
        self, x: Numbers, y: Numbers, colour: str, *, dashed: bool = False, width: float = 1.5
    ) -> None:
        """Draw a line through points (N,)."""
        step = -(-len(x) // _MOST_POINTS)
        rows = np.unique(np.append(np.arange(0, len(x), max(step, 1)), max(len(x) - 1, 0)))
        points = (
            (self.x(a), self.y(b)) for a, b in zip(x[rows].tolist(), y[rows].tolist(), strict=True)
        )
        style = ' stroke-dasharray="6 4" opacity="0.6"' if dashed else ""
        self._parts.append(svg.polyline(points, colour, width, f' stroke-linejoin="round"{style}'))

    def level(self, y: float, colour: str) -> None:
        """Draw a horizontal line."""
        left, _, width, _ = self._box
        at = self.y(y)
        self._parts.append(svg.line(left, at, left + width, at, colour, 1))

    def rectangle(
        self, x: tuple[float, float], y: tuple[float, float], colour: str, opacity: float = 1.0
    ) -> None:
        """Fill the area between two numbers of each axis."""
        low, high = sorted((self.y(y[0]), self.y(y[1])))
        left, width = self.x(x[0]), self.x(x[1]) - self.x(x[0])
        style = f' fill="{colour}" opacity="{opacity:g}"'
        self._parts.append(svg.rectangle(left, low, width, high - low, style))

    def circle(self, x: float, y: float, colour: str) -> None:
        """Draw a ring, as at the beginning of a path."""
        style = f' fill="#ffffff" stroke="{colour}" stroke-width="2"'
        self._front.append(svg.circle(self.x(x), self.y(y), 4, style))

    def cross(self, x: float, y: float, colour: str) -> None:
        """Draw a cross, as at the end of a path."""
        a, b = self.x(x), self.y(y)
        self._front += [
            svg.line(a - 4, b - 4, a + 4, b + 4, colour, 2),
            svg.line(a - 4, b + 4, a + 4, b - 4, colour, 2),
        ]

    def _draw_axes(self, labels: tuple[str, str], title: str, names: Sequence[str]) -> None:
        left, top, width, height = self._box
        base, middle = top + height, top + height / 2
        ticks = [(float(i), printable(name)) for i, name in enumerate(names)] or _ticks(*self._x, 7)
        for number, text in ticks:
            at = self.x(number)
            self._parts.append(svg.line(at, top, at, base, _GRID, 1))
            self._parts.append(_text(at, base + 15, text, anchor="middle"))
        for number, text in _ticks(*self._y, 5):
            at = self.y(number)
            self._parts.append(svg.line(left, at, left + width, at, _GRID, 1))
            self._parts.append(_text(left - 6, at + 4, text, anchor="end"))
        frame = svg.rectangle(left, top, width, height, ' fill="none" stroke="#999999"')
        self._front.append(frame)
        self._front.append(_text(left + width / 2, base + 32, labels[0], anchor="middle"))
        turn = f' transform="rotate(-90 {left - 46:.1f} {middle:.1f})"'
        self._front.append(_text(left - 46, middle, labels[1], anchor="middle", extra=turn))
        if title:
            self._front.append(_text(left, top - 9, printable(title), extra=' font-weight="bold"'))


def _widened(low: float, high: float) -> tuple[float, float]:
    """Return the range with a margin, so that lines do not lie on the frame."""
    margin = 0.04 * (high - low)
    if high - low <= 1e-10 * max(1.0, abs(low)):  # a constant, apart from rounding errors
        margin = 0.5 + 0.001 * abs(low)
    return low - margin, high + margin


def _ticks(low: float, high: float, about: int) -> list[tuple[float, str]]:
    """Round numbers within a range, and their texts."""
    rough = (high - low) / about
    power = 10.0 ** math.floor(math.log10(rough))
    step = power * next(factor for factor in (1, 2, 5, 10) if factor * power >= rough * 0.999)
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    numbers = np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step
    return [(float(n), f"{n + 0.0:.{decimals}f}") for n in numbers]


def _text(x: float, y: float, text: str, *, anchor: str = "start", extra: str = "") -> str:
    return svg.text(x, y, text, _SIZE, _TEXT, f' text-anchor="{anchor}"{extra}')
