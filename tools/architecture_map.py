"""Draws the packages and their imports as SVG: a row for each layer, arrows only downwards."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from architecture import ENGINE, SHELLS, room, strong_components

if TYPE_CHECKING:
    from architecture import House

WIDTH, BOX, ROW, TOP = 1180, 30, 82, 12
STYLE = """
  text { font: 13px system-ui, sans-serif; fill: #1b2a35 }
  rect { stroke: #7d8f9b; rx: 6 } .engine { fill: #dcefe6 } .ros { fill: #e3ebf7 }
  .shells { fill: #f6eeda } path { fill: none; stroke: #8fa1ad } .up { stroke: #c0392b }
  @media (prefers-color-scheme: dark) {
    text { fill: #e4ebf0 } path { stroke: #6b7f8c }
    .engine { fill: #1f4a3a } .ros { fill: #243b5c } .shells { fill: #54471f }
  }
"""


def draw(house: House) -> str:
    """Return the picture; the same for the same imports."""
    arrows = house.rooms()
    rows = _rows(arrows)
    places = {
        name: ((index + 0.5) * WIDTH / len(row), TOP + number * ROW)
        for number, row in enumerate(reversed(rows))
        for index, name in enumerate(row)
    }
    lines = [
        _arrow(places[source], places[target], "")
        for source, targets in _essential(arrows).items()
        for target in sorted(targets)
    ]
    upward = sorted({(room(source), room(target)) for source, target in house.excused})
    lines += [_arrow(places[source], places[target], ' class="up"') for source, target in upward]
    boxes = [_box(name, place) for name, place in sorted(places.items())]
    height = TOP + len(rows) * ROW
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" role="img" '
        f'aria-label="Rooms of turtlewire and who imports whom">\n<style>{STYLE}</style>\n'
        + "\n".join([*lines, *boxes])
        + "\n</svg>\n"
    )


def _rows(arrows: dict[str, set[str]]) -> list[list[str]]:
    """Return the rooms by height, the lowest first; a room stands above all that it imports."""
    height: dict[str, int] = {}
    for group in strong_components(arrows, arrows):
        below = {target for name in group for target in arrows[name]} - {*group}
        for name in group:
            height[name] = 1 + max((height[target] for target in below), default=-1)
    rows: list[list[str]] = []
    for level in range(max(height.values()) + 1):
        row = [name for name in arrows if height[name] == level]
        rows.append(sorted(row, key=lambda name: (_middle(name, arrows, rows), name)))
    return rows


def _middle(name: str, arrows: dict[str, set[str]], rows: list[list[str]]) -> float:
    """Return the mean position of a room's imports, from 0 to 1, so that few arrows cross."""
    spots = [
        (index + 0.5) / len(row)
        for row in rows
        for index, other in enumerate(row)
        if other in arrows[name]
    ]
    return round(sum(spots) / len(spots), 6) if spots else 0.5


def _essential(arrows: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the arrows without those that a longer way says too."""
    reach: dict[str, set[str]] = {}
    for name, *_ in strong_components(arrows, arrows):
        reach[name] = set().union(*({t} | reach.get(t, set()) for t in arrows[name]), set())
    return {
        name: {
            target
            for target in targets
            if not any(target in reach.get(other, set()) for other in targets - {target})
        }
        for name, targets in arrows.items()
    }


def _arrow(start: tuple[float, float], end: tuple[float, float], style: str) -> str:
    x, y, to_x, to_y = start[0], start[1] + BOX, end[0], end[1]
    if to_y < y:  # upwards: along the sides of the boxes
        y, to_y = start[1], end[1] + BOX
    bend = (y + to_y) / 2
    way = f"M{x:.0f} {y:.0f}C{x:.0f} {bend:.0f} {to_x:.0f} {bend:.0f} {to_x:.0f} {to_y:.0f}"
    return f'<path{style} d="{way}"/>'


def _box(name: str, place: tuple[float, float]) -> str:
    in_engine = name == ENGINE or name.startswith(f"{ENGINE}.")
    kind = "shells" if name == SHELLS else "engine" if in_engine else "ros"
    x, y = place
    width = 8 * len(name) + 16
    return (
        f'<rect class="{kind}" x="{x - width / 2:.0f}" y="{y}" width="{width}" height="{BOX}"/>'
        f'<text x="{x:.0f}" y="{y + 20}" text-anchor="middle">{escape(name)}</text>'
    )
