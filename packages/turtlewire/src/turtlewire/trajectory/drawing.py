"""One plot of several trajectories, or of the errors of several estimates."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal

from turtlewire.trajectory.error_plots import plot_box, plot_histogram
from turtlewire.trajectory.metrics import PoseErrors
from turtlewire.trajectory.plots import KINDS, Kind, plot_trajectories
from turtlewire.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from turtlewire.trajectory.chart import Plot

__all__ = ["plot"]

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
        TypeError: The kind does not draw what is named.
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
        return _OF_ERRORS[kind](errors)
    raise TypeError(
        f"'{kind}' draws {'trajectories' if kind in KINDS else 'errors'} by name; `plot` was "
        f"called with {', '.join(sorted({type(each).__name__ for each in named.values()}))}. "
        f"Kinds for trajectories: {', '.join(KINDS)}; kinds for errors: {', '.join(_OF_ERRORS)}"
    )
