"""Pictures of trajectories, as SVG.

Lines end where data are missing: nothing is drawn across a gap.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np

from turtlewire.trajectory.chart import COLOURS, GREY, Panel, Plot, page

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]
    Named = Mapping[str, "Drawable"]

__all__ = [
    "KINDS",
    "PATH_HEIGHT",
    "WIDTH",
    "Drawable",
    "Kind",
    "colours",
    "columns_of",
    "path_panel",
    "plot_trajectories",
    "runs_of",
]

Kind = Literal["path", "positions", "angles", "speeds"]
KINDS = ("path", "positions", "angles", "speeds")


class Drawable(Protocol):
    """A trajectory, as far as it is drawn; see `turtlewire.trajectory.Trajectory`."""

    @property
    def stamps_ns(self) -> NDArray[np.int64]:
        """(N,) in nanoseconds."""

    def __len__(self) -> int: ...
    @property
    def gaps(self) -> Sequence[tuple[int, int]]:
        """First and last stamp of each time without data."""

    @property
    def positions(self) -> Numbers:
        """(N, 3) in metres."""

    @property
    def euler(self) -> Numbers:
        """(N, 3) in radians."""

    @property
    def speeds(self) -> Numbers:
        """(N - 1,) in m/s."""


WIDTH = 640.0
_ROW = 170.0
PATH_HEIGHT = 480.0
_AXES = "xyz"


def plot_trajectories(
    named: Named, kind: str = "path", reference: Drawable | None = None, plane: str = "xy"
) -> Plot:
    """Draw trajectories by name; see `turtlewire.trajectory.plot`."""
    if kind not in KINDS:
        raise ValueError(f"'{kind}' is not a kind of plot; choose from {', '.join(KINDS)}")
    if reference is not None and not hasattr(reference, "positions"):
        raise TypeError(f"reference must be a Trajectory, not {type(reference).__name__}")
    named = {name: each for name, each in named.items() if len(each)}
    if not named:
        raise ValueError("there is no pose to draw")
    if kind == "path":
        return _plot_path(named, reference, plane)
    labels, values_of = _OVER_TIME[kind]
    return _over_time(named, reference, labels, values_of)


def _plot_path(named: Named, reference: Drawable | None, plane: str) -> Plot:
    """Return the paths, with a ring at the start and a cross at the end."""
    across, up = columns_of(plane)
    everything = [*named.values(), *([] if reference is None else [reference])]
    panel = path_panel(everything, plane, WIDTH)
    legend = []
    if reference is not None:
        legend.append(("reference", GREY))
        for rows in runs_of(reference):
            at = reference.positions[rows]
            panel.line(at[:, across], at[:, up], GREY, dashed=True)
    for (name, trajectory), colour in zip(named.items(), colours(), strict=False):
        legend.append((name, colour))
        for rows in runs_of(trajectory):
            at = trajectory.positions[rows]
            panel.line(at[:, across], at[:, up], colour)
        _mark_ends(panel, trajectory, (across, up), colour)
    return page([panel], WIDTH, legend)


def _positions(trajectory: Drawable) -> Numbers:
    return trajectory.positions


def _angles(trajectory: Drawable) -> Numbers:
    return np.degrees(trajectory.euler)


def _speeds(trajectory: Drawable) -> Numbers:
    """(N, 1) the speed at each pose: the mean speed of the way to the next one."""
    values = np.append(trajectory.speeds, 0.0)
    for run in runs_of(trajectory):  # the last segment leads into a gap
        values[run.stop - 1] = values[run.stop - 2] if run.stop - run.start > 1 else 0.0
    return values[:, None]


#: Of each kind over time: the labels of its rows and the values that they show.
_OVER_TIME: dict[str, tuple[list[str], Callable[[Drawable], Numbers]]] = {
    "positions": ([f"{axis} [m]" for axis in _AXES], _positions),
    "angles": (["roll [deg]", "pitch [deg]", "yaw [deg]"], _angles),
    "speeds": (["speed [m/s]"], _speeds),
}


def colours() -> Iterator[str]:
    """Yield the colours of the first trajectory, the second …, without end."""
    while True:
        yield from COLOURS


def columns_of(plane: str) -> tuple[int, int]:
    """Return the columns of positions that are the two axes of a plane such as ``xy``."""
    if len(plane) != 2 or not set(plane) <= set(_AXES) or plane[0] == plane[1]:
        raise ValueError(f"'{plane}' is not a plane; choose from xy, xz, yz, yx, zx and zy")
    return _AXES.index(plane[0]), _AXES.index(plane[1])


def runs_of(trajectory: Drawable) -> list[slice]:
    """Return the rows between the gaps."""
    starts = [end for _, end in trajectory.gaps]
    cuts = np.unique(np.searchsorted(trajectory.stamps_ns, np.array(starts, np.int64)))
    ends = [0, *(int(cut) for cut in cuts if 0 < cut < len(trajectory)), len(trajectory)]
    return [slice(a, b) for a, b in pairwise(ends)]


def _range(numbers: list[Numbers]) -> tuple[float, float]:
    return min(float(each.min()) for each in numbers), max(float(each.max()) for each in numbers)


def path_panel(trajectories: Sequence[Drawable], plane: str, width: float) -> Panel:
    """Axes with room for the paths, a metre being as long on both."""
    across, up = columns_of(plane)
    places = [each.positions for each in trajectories if len(each)]
    labels = f"{plane[0]} [m]", f"{plane[1]} [m]"
    x_range, y_range = (_range([at[:, column] for at in places]) for column in (across, up))
    return Panel((0.0, 0.0, width, PATH_HEIGHT), x_range, y_range, labels, equal=True)


def _mark_ends(panel: Panel, trajectory: Drawable, columns: tuple[int, int], colour: str) -> None:
    first, last = trajectory.positions[0], trajectory.positions[-1]
    panel.circle(float(first[columns[0]]), float(first[columns[1]]), colour)
    panel.cross(float(last[columns[0]]), float(last[columns[1]]), colour)


def _over_time(
    named: Named,
    reference: Drawable | None,
    labels: list[str],
    values_of: Callable[[Drawable], Numbers],
) -> Plot:
    """Draw one row for each column of the values."""
    shown = [
        (name, each, colour) for (name, each), colour in zip(named.items(), colours(), strict=False)
    ]
    if reference is not None and len(reference):
        shown.insert(0, ("reference", reference, GREY))
    start = min(int(each.stamps_ns[0]) for _, each, _ in shown)
    seconds = [(each.stamps_ns - start) / 1e9 for _, each, _ in shown]
    values = [values_of(each) for _, each, _ in shown]
    panels = []
    for row, label in enumerate(labels):
        place = (0.0, row * _ROW, WIDTH, _ROW)
        y_range = _range([each[:, row] for each in values])
        panels.append(Panel(place, _range(seconds), y_range, ("time [s]", label)))
        for (_, each, colour), x, y in zip(shown, seconds, values, strict=True):
            for run in runs_of(each):
                panels[-1].line(x[run], y[run, row], colour, dashed=colour == GREY)
    return page(panels, WIDTH, [(name, colour) for name, _, colour in shown])
