"""Errors of an estimated trajectory against a reference: APE, RPE and their statistics.

Source: Sturm et al., "A Benchmark for the Evaluation of RGB-D SLAM Systems", IROS 2012; names and
definitions of the variants are the program evo's, so that figures can be compared.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from turtlewire.call_errors import hint_at
from turtlewire.geometry import arrays
from turtlewire.wording import counted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.trajectory.trajectory import Trajectory

__all__ = [
    "RELATIONS",
    "PoseErrors",
    "Relation",
    "Statistics",
    "Unit",
    "ape",
    "distance_text",
    "pairs",
    "rpe",
]

Relation = Literal[
    "trans_part",
    "rot_part",
    "full",
    "angle_rad",
    "angle_deg",
    "point_distance",
    "point_distance_error_ratio",
]
Unit = Literal["f", "m", "d", "r"]

#: What is measured, and its unit.
RELATIONS: dict[Relation, str] = {
    "trans_part": "m",
    "rot_part": "",
    "full": "",
    "angle_rad": "rad",
    "angle_deg": "deg",
    "point_distance": "m",
    "point_distance_error_ratio": "%",
}

#: The units of `rpe`'s ``delta``.
_UNITS: dict[Unit, str] = {"f": "frames", "m": "m", "d": "deg", "r": "rad"}

#: An angle also reaches a bound if it is smaller by this fraction. Three turns by 10 degrees make
#: 30, however the doubles are rounded; in evo, rounding decides.
_ROUNDING = 1e-9


class Statistics(NamedTuple):
    """Statistics of errors, in evo's order."""

    max: float
    mean: float
    median: float
    min: float
    rmse: float
    sse: float
    std: float


@hint_at(
    {
        "rmse mean median std sse max min stats": "statistics, which has max, mean, median, min, "
        "rmse, sse and std",
        "errors error data": "values, (N,)",
        "plot": "the comparison's plot(), or turtlewire.trajectory.plot({name: errors})",
        "to_pandas dataframe df": "values, (N,), and rows, (N,)",
    }
)
class PoseErrors(NamedTuple):
    """Errors of poses or of pairs of poses.

    Attributes:
        name: ``APE`` or ``RPE``.
        relation: What is measured; see `Comparison.ape`.
        values: (N,) the errors.
        rows: (N,) the row of the associated trajectories that each belongs to; of a pair the later.
    """

    name: str
    relation: Relation
    values: NDArray[np.float64]
    rows: NDArray[np.intp]

    @property
    def unit(self) -> str:
        """``m``, ``rad``, ``deg``, ``%`` or nothing."""
        return RELATIONS[self.relation]

    @property
    def statistics(self) -> Statistics:
        """The statistics; the standard deviation is the population's."""
        e = self.values
        sse = float(np.einsum("i,i->", e, e))  # dot() wakes BLAS's threads, which takes longer
        return Statistics(
            max=float(e.max()),
            mean=float(e.mean()),
            median=_median(e),
            min=float(e.min()),
            rmse=float(np.sqrt(sse / len(e))),
            sse=sse,
            std=float(e.std()),
        )

    def table(self) -> str:
        """Return the statistics as evo prints them: name and value a line, separated by a tab."""
        return "".join(f"{k:>10}\t{v:.6f}\n" for k, v in self.statistics._asdict().items())


def _median(values: NDArray[np.float64]) -> float:
    # One place alone is partitioned with SIMD: a sixth of the time of `numpy.median`.
    middle = len(values) // 2
    parted = np.partition(values, middle)
    upper = float(parted[middle])
    return upper if len(values) % 2 else (float(parted[:middle].max()) + upper) / 2


def ape(
    reference: Trajectory, estimate: Trajectory, relation: Relation = "trans_part"
) -> PoseErrors:
    """Absolute pose error: ``inverse(reference) * estimate`` of each pose.

    Args:
        reference: The reference.
        estimate: The estimate; row i belongs to row i of the reference. See `associate` and
            `align`.
        relation: A key of `RELATIONS` except ``point_distance_error_ratio``.

    Raises:
        ValueError: The trajectories differ in length, or the relation is another.
    """
    _check(reference, estimate, relation, tuple(RELATIONS)[:-1])
    rows = np.arange(len(reference))
    distance = arrays.distances(reference.positions, estimate.positions)
    if relation in ("trans_part", "point_distance"):
        return PoseErrors("APE", relation, distance, rows)
    turn = arrays.multiply(arrays.conjugate(reference.rotations), estimate.rotations)
    return PoseErrors("APE", relation, _value(relation, distance, turn), rows)


def rpe(
    reference: Trajectory,
    estimate: Trajectory,
    relation: Relation = "trans_part",
    *,
    delta: float = 1,
    unit: Unit = "f",
    all_pairs: bool = False,
    tolerance: float = 0.1,
    pairs_from_reference: bool = False,
) -> PoseErrors:
    """Relative pose error: how the motion between two poses differs.

    Args:
        reference: The reference.
        estimate: The estimate; row i belongs to row i of the reference.
        relation: A key of `RELATIONS`.
        delta: How far the poses of a pair are apart; a pair ends at the first pose that is as far.
        unit: Of ``delta``: ``f`` frames, ``m`` metres of path, ``d`` degrees, ``r`` radians.
        all_pairs: Whether a pair begins at each pose, not only where the last one ended. For
            angles these are all pairs of poses whose rotations differ by ``delta``.
        tolerance: Of the distance in such pairs, as a share of ``delta``.
        pairs_from_reference: Whether path and angles are taken along the reference, not the
            estimate.

    Raises:
        ValueError: The trajectories differ in length, a name is unknown, or there is no pair.
    """
    _check(reference, estimate, relation, tuple(RELATIONS))
    source = reference if pairs_from_reference else estimate
    i, j = pairs(source, delta, unit, all_pairs=all_pairs, tolerance=tolerance)
    if not len(i):
        apart = distance_text(delta, unit)
        poses = counted(len(source), "pose")
        raise ValueError(f"no two poses are {apart} apart; the trajectory has {poses}")
    if relation.startswith("point_distance"):
        return _rpe_of_distances(reference, estimate, relation, i, j)
    distance = arrays.lengths(_move(estimate, i, j) - _move(reference, i, j))
    if relation == "trans_part":
        return PoseErrors("RPE", relation, distance, j)
    back = arrays.conjugate(_turn(reference, i, j))
    turn = arrays.multiply(back, _turn(estimate, i, j))
    return PoseErrors("RPE", relation, _value(relation, distance, turn), j)


def _rpe_of_distances(
    reference: Trajectory,
    estimate: Trajectory,
    relation: Relation,
    i: NDArray[np.intp],
    j: NDArray[np.intp],
) -> PoseErrors:
    q = arrays.lengths(reference.positions[i] - reference.positions[j])
    p = arrays.lengths(estimate.positions[i] - estimate.positions[j])
    errors = np.abs(q - p)
    if relation == "point_distance_error_ratio":
        moved = q > 0
        if not moved.any():
            raise ValueError("no ratio of distances: the reference does not move")
        errors, j = errors[moved] / q[moved] * 100, j[moved]
    return PoseErrors("RPE", relation, errors, j)


def _move(trajectory: Trajectory, i: NDArray[np.intp], j: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return the position of pose j as pose i sees it."""
    back = arrays.conjugate(trajectory.rotations[i])
    return arrays.rotate(back, trajectory.positions[j] - trajectory.positions[i])


def _turn(trajectory: Trajectory, i: NDArray[np.intp], j: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return the rotation of pose j as pose i sees it."""
    return arrays.multiply(arrays.conjugate(trajectory.rotations[i]), trajectory.rotations[j])


def _value(
    relation: str, distance: NDArray[np.float64], turn: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the error of each difference, given the length of its translation and its rotation."""
    if relation.startswith("angle"):
        angles = arrays.angle(turn)
        return np.degrees(angles) if relation == "angle_deg" else angles
    # The Frobenius norm of R - I is 2 sqrt(2) |sin(angle / 2)|, and that sine is the length of xyz.
    sine = arrays.lengths(turn[:, :3])
    squares = 8 * sine**2 if relation == "rot_part" else 8 * sine**2 + distance**2
    norms: NDArray[np.float64] = np.sqrt(squares)
    return norms


def _check(
    reference: Trajectory, estimate: Trajectory, relation: str, known: tuple[str, ...]
) -> None:
    if relation not in known:
        if relation in RELATIONS:
            raise ValueError(f"'{relation}' is measured by rpe(), not by ape()")
        raise ValueError(f"unknown relation '{relation}'; choose from {', '.join(known)}")
    if len(reference) != len(estimate):
        raise ValueError(
            f"the trajectories have {len(reference)} and {len(estimate)} poses; associate them "
            "first"
        )


def distance_text(delta: float, unit: Unit) -> str:
    """Return `rpe`'s ``delta`` with its unit: ``1 frame``, ``0.5 m``."""
    return counted(int(delta), "frame") if unit == "f" else f"{delta:g} {_UNITS[unit]}"


def pairs(
    trajectory: Trajectory, delta: float, unit: Unit, *, all_pairs: bool, tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows of the pairs of poses that are ``delta`` apart; see `rpe`."""
    if unit not in _UNITS:
        raise ValueError(f"unknown unit '{unit}'; choose from f, m, d and r")
    if not isinstance(delta, (int, float, np.number)):
        raise TypeError(
            f"delta must be a number, not {type(delta).__name__}; pass its unit separately: "
            "delta=10, unit='m'"
        )
    if not 0 < delta < np.inf:
        raise ValueError(f"delta is {delta}; it must be a positive number")
    if unit == "f":
        if delta != int(delta):
            raise ValueError(f"delta is {delta} frames; it must be a whole number")
        return _frame_pairs(len(trajectory), int(delta), all_pairs=all_pairs)
    if unit == "m":
        if all_pairs:
            return _distance_pairs(trajectory.distances, delta, delta * tolerance)
        return _consecutive_pairs(arrays.lengths(np.diff(trajectory.positions, axis=0)), delta)
    q = trajectory.rotations
    angle = float(np.radians(delta)) if unit == "d" else delta
    if all_pairs:
        return _angle_pairs(q, angle, angle * (tolerance + _ROUNDING))
    turns = arrays.multiply(arrays.conjugate(q[:-1]), q[1:])
    return _consecutive_pairs(arrays.angle(turns), angle * (1.0 - _ROUNDING))


def _frame_pairs(
    count: int, delta: int, *, all_pairs: bool
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    starts = np.arange(0, count - delta, 1 if all_pairs else delta, dtype=np.intp)
    return starts, starts + delta


def _consecutive_pairs(
    steps: NDArray[np.float64], delta: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs that follow each other: each ends where ``delta`` is reached since the last.

    The steps are summed from zero in each pair, as evo does. Sums of all steps before would round
    differently, and where steps divide ``delta`` evenly, pairs would end one pose off.
    """
    rows, walked = [0], 0.0
    for row, step in enumerate(steps.tolist(), start=1):
        walked += step
        if walked >= delta:
            rows.append(row)
            walked = 0.0
    ends = np.array(rows, dtype=np.intp)
    return ends[:-1], ends[1:]


def _angle_pairs(
    rotations: NDArray[np.float64], delta: float, tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """All pairs whose rotations differ by about ``delta``; takes time with the square of (N)."""
    ends = [
        row
        + 1
        + np.flatnonzero(np.abs(_turned(rotations[row], rotations[row + 1 :]) - delta) <= tolerance)
        for row in range(len(rotations))
    ]
    starts = np.repeat(np.arange(len(rotations)), [len(found) for found in ends])
    return starts, np.concatenate([*ends, np.zeros(0, dtype=np.intp)])


def _turned(first: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.float64]:
    return arrays.angle(arrays.multiply(arrays.conjugate(first), others))


def _distance_pairs(
    along: NDArray[np.float64], delta: float, tolerance: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return for each row the later one whose distance is nearest to ``delta``, if near enough.

    Of several as near the first is taken.
    """
    starts = np.arange(len(along) - 1, dtype=np.intp)
    after = np.clip(np.searchsorted(along, along[:-1] + delta), starts + 1, len(along) - 1)
    # While the robot stands, several poses are at one distance.
    before = np.searchsorted(along, along[np.maximum(after - 1, starts + 1)])
    before = np.maximum(before, starts + 1)
    short, long = (np.abs(along[ends] - along[:-1] - delta) for ends in (before, after))
    ends = np.where(short <= long, before, after)
    near = np.minimum(short, long) <= tolerance
    return starts[near], ends[near]
