"""Compares an estimated trajectory with a reference, in one call."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from html import escape
from typing import TYPE_CHECKING, Literal

import numpy as np

from turtlewire.call_errors import explain_call, explain_calls, hint_at
from turtlewire.tf.datetimes import as_nanoseconds
from turtlewire.trajectory import alignment
from turtlewire.trajectory.alignment import Alignment, AlignmentName, associate
from turtlewire.trajectory.error_plots import plot_error_path, plot_errors
from turtlewire.trajectory.metrics import PoseErrors, Relation, Unit, ape, rpe
from turtlewire.trajectory.stamps import Gap, find_gaps
from turtlewire.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.tf.datetimes import Span
    from turtlewire.trajectory.chart import Plot

__all__ = ["Comparison", "compare"]

_MAX_DIFF_NS = 10_000_000


@hint_at(
    {
        "rmse statistics stats mean max std errors": "ape().statistics, or rpe().statistics",
        "ate": "ape()",
    }
)
@explain_calls
@dataclass(frozen=True)
class Comparison:
    """Two trajectories, pose by pose.

    Attributes:
        reference: The reference, at the poses that have a partner. It has a gap where either
            trajectory has one, or where partners are missing for a while.
        estimate: The estimate at the same rows, aligned, with the same gaps.
        align: How it was aligned.
        alignment: The transform that was applied to the estimate.
    """

    reference: Trajectory
    estimate: Trajectory
    align: str
    alignment: Alignment

    def ape(self, relation: Relation = "trans_part") -> PoseErrors:
        """Return the absolute pose error: ``inverse(reference) * estimate`` of each pose.

        Args:
            relation: What is measured: ``trans_part`` or ``point_distance`` (metres),
                ``angle_rad``, ``angle_deg``, ``rot_part`` or ``full`` (both without a unit).

        Raises:
            ValueError: The relation is another one.
        """
        return ape(self.reference, self.estimate, relation)

    def rpe(
        self,
        relation: Relation = "trans_part",
        *,
        delta: float = 1,
        unit: Unit = "f",
        all_pairs: bool = False,
        tolerance: float = 0.1,
        pairs_from_reference: bool = False,
    ) -> PoseErrors:
        """Return the relative pose error: how the motion between two poses differs.

        Errors and pairs are evo's, except that an angle reaches ``delta`` if it is short of it by
        a rounding (a billionth) only.

        Args:
            relation: What is measured; see `ape`. Pairs of poses also have
                ``point_distance_error_ratio`` (percent).
            delta: How far the poses of a pair are apart.
            unit: The unit of ``delta``: ``f`` frames, ``m`` metres of path, ``d`` degrees, ``r``
                radians.
            all_pairs: True if a pair begins at each pose, not only where the last one ended. For
                angles these are all pairs of poses whose rotations differ by ``delta``.
            tolerance: Of the distance in such pairs, as a share of ``delta``.
            pairs_from_reference: True if path and angles are taken along the reference, not the
                estimate.

        Raises:
            ValueError: A name is unknown, or there is no pair.
        """
        return rpe(
            self.reference,
            self.estimate,
            relation,
            delta=delta,
            unit=unit,
            all_pairs=all_pairs,
            tolerance=tolerance,
            pairs_from_reference=pairs_from_reference,
        )

    def plot(
        self,
        kind: Literal["path", "errors"] = "path",
        *,
        relation: Relation = "trans_part",
        plane: str = "xy",
    ) -> Plot:
        """Return a plot of the absolute pose error.

        Args:
            kind: ``path``: the path of the estimate, coloured by the error, on the dashed
                reference; ``errors``: the error over time, with its statistics.
            relation: What is measured; see `ape`.
            plane: The axes of ``path``: ``xy``, ``xz``, ``yz`` or the other way round.

        Raises:
            ValueError: The kind of plot, the relation or the plane does not exist.
        """
        errors = self.ape(relation)
        if kind == "path":
            return plot_error_path(self.reference, self.estimate, errors, plane)
        if kind == "errors":
            return plot_errors(errors, self.reference)
        advice = (
            "; plot({name: comparison.ape()}, kind) draws it"
            if kind in ("box", "histogram")
            else ""
        )
        raise ValueError(f"'{kind}' is not a kind of plot; choose from path, errors{advice}")

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.table())}</pre>\n{self.plot().svg}"

    def table(self, relation: Relation = "trans_part") -> str:
        """Return the statistics of the APE as evo prints them; the heading has the alignment."""
        errors = self.ape(relation)
        unit = f" ({errors.unit})" if errors.unit else ""
        scale = f", scale {self.alignment.scale:.6f}" if self.align == "sim3" else ""
        return f"APE {relation}{unit}, aligned: {self.align}{scale}\n\n{errors.table()}"


@explain_call
def compare(
    reference: Trajectory,
    estimate: Trajectory,
    align: AlignmentName = "none",
    *,
    max_diff_ns: Span = _MAX_DIFF_NS,
    offset_ns: Span = 0,
    poses_to_align: int | None = None,
) -> Comparison:
    """Associate two trajectories by time and align the estimate.

    If only one has times (KITTI), both must have as many poses. They are paired by their number,
    and a ``UserWarning`` says so.

    Args:
        reference: The reference, for example ground truth.
        estimate: The estimate.
        align: ``none``; ``origin``: the first poses coincide; ``yaw``: least squares over
            translation and rotation about z, for estimates that know where down is; ``se3``: least
            squares over translation and rotation; ``sim3``: and scale.
        max_diff_ns: Poses whose stamps differ by more do not belong together.
        offset_ns: Added to the stamps of the estimate, for clocks that differ.
        poses_to_align: Align by this number of first poses only; None for all.

    Returns:
        The pairs, for APE, RPE and plots.

    Raises:
        TypeError: An argument is not a trajectory.
        ValueError: No stamps match, the numbers of poses differ and not both have times,
            ``poses_to_align`` is not positive, or the alignment is not possible.
    """
    for given in (reference, estimate):
        if not isinstance(given, Trajectory):
            raise TypeError(
                f"compare accepts two trajectories, got {type(given).__name__}; read a file with "
                "Trajectory.load(path)"
            )
    if poses_to_align is not None and poses_to_align < 1:
        raise ValueError(
            f"poses_to_align is {poses_to_align}; it must be positive, or None for all"
        )
    if reference.timed and estimate.timed:
        rows = associate(
            reference,
            estimate,
            as_nanoseconds(max_diff_ns, "max_diff_ns"),
            as_nanoseconds(offset_ns, "offset_ns"),
        )
    else:
        reference, estimate = _paired_by_number(reference, estimate)
        rows = np.arange(len(reference)), np.arange(len(reference))
    # The stamps of a pair may repeat (one pose may be the nearest of two): the shorter one's do
    # not.
    short = reference if len(reference) < len(estimate) else estimate
    stamps = short.stamps_ns[rows[0] if short is reference else rows[1]]
    gaps = _gaps_between(stamps, (reference, rows[0]), (estimate, rows[1]))
    first = _at(reference, rows[0], stamps, gaps)
    second = _at(estimate, rows[1], stamps, gaps)
    moved = alignment.align(first[:poses_to_align], second[:poses_to_align], align)
    return Comparison(first, moved.apply(second), align, moved)


def _paired_by_number(reference: Trajectory, estimate: Trajectory) -> tuple[Trajectory, Trajectory]:
    """Give a trajectory without times the stamps of the other.

    Raises:
        ValueError: The trajectories differ in length.
    """
    if len(reference) != len(estimate):
        raise ValueError(
            "without times, both trajectories must have the same number of poses; these have "
            f"{len(reference)} and {len(estimate)} (KITTI's times are read from "
            "<name>_times.txt)"
        )
    if reference.timed or estimate.timed:
        which = "estimate" if reference.timed else "reference"
        warnings.warn(
            f"the {which} has no times: its poses are paired with the others by their number",
            stacklevel=4,
        )
    if reference.timed:
        return reference, replace(estimate, stamps_ns=reference.stamps_ns)
    return replace(reference, stamps_ns=estimate.stamps_ns), estimate


def _gaps_between(
    stamps: NDArray[np.int64], *parts: tuple[Trajectory, NDArray[np.intp]]
) -> tuple[Gap, ...]:
    """Return the gaps of the pairs: where either trajectory has one, or partners are missing."""
    is_gap = np.isin(stamps[:-1], [gap.start_ns for gap in find_gaps(stamps)])
    for trajectory, rows in parts:
        ends = np.array([gap.end_ns for gap in trajectory.gaps], np.int64)
        gaps_before = np.searchsorted(ends, trajectory.stamps_ns, side="right")
        is_gap |= np.diff(gaps_before[rows]) != 0
    return tuple(Gap(int(stamps[i]), int(stamps[i + 1])) for i in np.flatnonzero(is_gap))


def _at(
    trajectory: Trajectory,
    rows: NDArray[np.intp],
    stamps: NDArray[np.int64],
    gaps: tuple[Gap, ...],
) -> Trajectory:
    frames = trajectory.target_frame, trajectory.source_frame
    return Trajectory(stamps, trajectory.poses[rows], *frames, gaps)
