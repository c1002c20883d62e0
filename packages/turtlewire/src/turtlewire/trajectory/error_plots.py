"""Plots of errors: over time, along the path, and of several estimates side by side, as SVG.

`plot` draws several trajectories or errors in one plot.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Literal

import numpy as np

from turtlewire.trajectory.chart import COLOURS, GREY, Panel, Plot, colour_of, page
from turtlewire.trajectory.metrics import PoseErrors
from turtlewire.trajectory.plots import (
    KINDS,
    PATH_HEIGHT,
    WIDTH,
    Kind,
    colours,
    columns_of,
    path_panel,
    plot_trajectories,
    runs_of,
)
from turtlewire.trajectory.trajectory import Trajectory

__all__ = [
    "plot",
    "plot_box",
    "plot_error_path",
    "plot_errors",
    "plot_histogram",
]

_COLOUR_STEPS = 24
_BAR = 104.0


def plot_errors(errors: PoseErrors, reference: Trajectory) -> Plot:
    """PoseErrors over time, with lines for rmse, median and mean and a band of the deviation.

    Args:
        errors: What `ape` or `rpe` returned.
        reference: The compared poses, for their times and gaps.
    """
    values = errors.values
    seconds = (reference.stamps_ns[errors.rows] - reference.stamps_ns[0]) / 1e9
    statistics = errors.statistics
    low, high = statistics.mean - statistics.std, statistics.mean + statistics.std
    place = (0.0, 0.0, WIDTH, 300.0)
    x_range = float(seconds[0]), float(seconds[-1])
    y_range = min(0.0, low), max(statistics.max, high)
    labels = "time [s]", _title(errors)
    panel = Panel(place, x_range, y_range, labels, title=_title(errors))
    panel.rectangle(x_range, (low, high), COLOURS[4], 0.25)
    for run in runs_of(reference):
        shown = (errors.rows >= run.start) & (errors.rows < run.stop)
        panel.line(seconds[shown], values[shown], GREY)
    legend = [("error", GREY), ("mean ± std", COLOURS[4])]
    for name, colour in (("rmse", COLOURS[1]), ("median", COLOURS[2]), ("mean", COLOURS[0])):
        value = getattr(statistics, name)
        panel.level(value, colour)
        legend.append((f"{name} {value:.4g}", colour))
    return page([panel], WIDTH, legend)


def plot_error_path(
    reference: Trajectory, estimate: Trajectory, errors: PoseErrors, plane: str = "xy"
) -> Plot:
    """Return the path of the estimate, coloured by its error, on the dashed reference.

    Args:
        reference: Associated with the estimate.
        estimate: Likewise, aligned.
        errors: Of the two.
        plane: Two of the axes x, y and z, such as ``xy``.
    """
    across, up = columns_of(plane)
    panel = path_panel([reference, estimate], plane, WIDTH - _BAR)
    for rows in runs_of(reference):
        at = reference.positions[rows]
        panel.line(at[:, across], at[:, up], GREY, dashed=True)
    values = np.interp(np.arange(len(estimate)), errors.rows, errors.values)
    low, high = float(values.min()), float(values.max())
    shares = np.clip((values - low) / ((high - low) or 1.0), 0.0, 1.0)
    steps = np.round(shares * (_COLOUR_STEPS - 1)).astype(np.int64)
    for rows in runs_of(estimate):
        at, of_run = estimate.positions[rows], steps[rows]
        starts = np.concatenate(([0], np.flatnonzero(np.diff(of_run)) + 1, [len(of_run)]))
        for first, last in pairwise(starts):
            part = at[first : last + 1]  # up to the next colour's first pose
            colour = colour_of(of_run[first] / (_COLOUR_STEPS - 1))
            panel.line(part[:, across], part[:, up], colour, width=3)
    return page([panel, _colour_bar(low, high, _title(errors))], WIDTH)


def plot_box(errors: Mapping[str, PoseErrors]) -> Plot:
    """Box plots of several: quartiles, median, and whiskers to 1.5 times their distance."""
    labels, top = _labels(errors)
    place = (0.0, 0.0, WIDTH, 320.0)
    x_range = -0.5, len(errors) - 0.5
    panel = Panel(place, x_range, (0.0, top), ("", labels), title=labels, x_names=list(errors))
    for i, (each, colour) in enumerate(zip(errors.values(), colours(), strict=False)):
        low, middle, high = np.percentile(each.values, (25, 50, 75))
        reach = 1.5 * (high - low)
        inside = each.values[(each.values >= low - reach) & (each.values <= high + reach)]
        ends = float(inside.min()), float(inside.max())
        for a, b in ((ends[0], low), (high, ends[1])):
            panel.line(np.array([i, i]), np.array([a, b]), GREY)
        for end in ends:
            panel.line(np.array([i - 0.12, i + 0.12]), np.array([end, end]), GREY)
        panel.rectangle((i - 0.25, i + 0.25), (low, high), colour, 0.7)
        panel.line(np.array([i - 0.25, i + 0.25]), np.array([middle, middle]), "#000000", width=2)
    return page([panel], WIDTH)


def plot_histogram(errors: Mapping[str, PoseErrors], bins: int = 40) -> Plot:
    """Plot histograms of several errors on top of one another."""
    labels, top = _labels(errors)
    edges = np.linspace(0.0, top or 1.0, bins + 1)
    counts = {name: np.histogram(each.values, edges)[0] for name, each in errors.items()}
    most = float(max(count.max() for count in counts.values()))
    place = (0.0, 0.0, WIDTH, 300.0)
    panel = Panel(place, (0.0, float(edges[-1])), (0.0, most), (labels, "poses"), title=labels)
    legend = []
    for (name, count), colour in zip(counts.items(), colours(), strict=False):
        legend.append((name, colour))
        for i in np.flatnonzero(count):
            panel.rectangle((edges[i], edges[i + 1]), (0.0, float(count[i])), colour, 0.5)
    return page([panel], WIDTH, legend)


def _labels(errors: Mapping[str, PoseErrors]) -> tuple[str, float]:
    if not errors:
        raise ValueError("there are no errors to draw")
    return _title(next(iter(errors.values()))), max(float(e.values.max()) for e in errors.values())


def _title(errors: PoseErrors) -> str:
    return f"{errors.name} {errors.relation}" + (f" [{errors.unit}]" if errors.unit else "")


def _colour_bar(low: float, high: float, label: str) -> Panel:
    place = (WIDTH - _BAR, 0.0, _BAR, PATH_HEIGHT)
    bar = Panel(place, (0.0, 1.0), (low, high), ("", label), x_names=[""])
    for step in range(_COLOUR_STEPS):
        span = (high - low) or 1.0
        part = low + span * step / _COLOUR_STEPS, low + span * (step + 1) / _COLOUR_STEPS
        bar.rectangle((0.0, 1.0), part, colour_of(step / (_COLOUR_STEPS - 1)))
    return bar


_OF_ERRORS = {"box": plot_box, "histogram": plot_histogram}


def plot(
    named: Mapping[str, Trajectory | PoseErrors],
    kind: Kind | Literal["box", "histogram"] | None = None,
    *,
    reference: Trajectory | None = None,
    plane: str = "xy",
) -> Plot:
    """Draw several trajectories, or the errors of several estimates, with a legend of their names.

    Args:
        named: Trajectories, or what `Comparison.ape` or `Comparison.rpe` returned, by name.
        kind: For trajectories ``path``, ``positions``, ``angles`` or ``speeds``; for errors ``box``
            or ``histogram``. None uses the first of them.
        reference: A trajectory that is drawn dashed and grey, next to the others.
        plane: The axes of ``path``: ``xy``, ``xz``, ``yz`` or the other way round.

    Raises:
        TypeError: The kind does not draw what is named, or errors have a reference.
        ValueError: The kind of plot or the plane does not exist, or there is nothing to draw.
    """
    if not isinstance(named, Mapping):
        raise TypeError(
            f"`plot` draws a dict of trajectories or errors by name, not {type(named).__name__}: "
            "plot({'estimate': ...})"
        )
    if kind is None:
        kind = "box" if any(isinstance(each, PoseErrors) for each in named.values()) else "path"
    every = (*KINDS, *_OF_ERRORS)
    if kind not in every:
        raise ValueError(f"'{kind}' is not a kind of plot; choose from {', '.join(every)}")
    errors = {name: each for name, each in named.items() if isinstance(each, PoseErrors)}
    trajectories = {name: each for name, each in named.items() if isinstance(each, Trajectory)}
    if kind in KINDS and len(trajectories) == len(named):
        return plot_trajectories(trajectories, kind, reference, plane)
    if kind in _OF_ERRORS and len(errors) == len(named):
        if reference is not None:
            raise TypeError("a reference is drawn next to trajectories, not next to errors")
        return _OF_ERRORS[kind](errors)
    raise TypeError(
        f"'{kind}' draws {'trajectories' if kind in KINDS else 'errors'} by name; `plot` was "
        f"called with {', '.join(sorted({type(each).__name__ for each in named.values()}))}. "
        f"Kinds for trajectories: {', '.join(KINDS)}; kinds for errors: {', '.join(_OF_ERRORS)}"
    )
