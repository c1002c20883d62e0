"""Compares an estimated trajectory with a reference, in one call."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

from turtlewire.trajectory import alignment
from turtlewire.trajectory.alignment import Alignment, associate
from turtlewire.trajectory.error_plots import plot_error_path
from turtlewire.trajectory.metrics import Errors, ape, rpe
from turtlewire.trajectory.trajectory import Trajectory

if TYPE_CHECKING:
    from turtlewire.trajectory.chart import Plot

__all__ = ["Comparison", "compare"]

_MAX_DIFF_NS = 10_000_000


@dataclass(frozen=True)
class Comparison:
    """Two trajectories, pose by pose.

    Attributes:
        reference: The reference, at the poses that have a partner.
        estimate: The estimate at the same rows, aligned.
        align: How it was aligned.
        alignment: The transform that was applied to the estimate.
    """

    reference: Trajectory
    estimate: Trajectory
    align: str
    alignment: Alignment

    def ape(self, relation: str = "trans_part") -> Errors:
        """Absolute pose error; see `turtlewire.trajectory.ape`."""
        return ape(self.reference, self.estimate, relation)

    def rpe(
        self,
        relation: str = "trans_part",
        *,
        delta: float = 1,
        unit: str = "f",
        all_pairs: bool = False,
        tolerance: float = 0.1,
        pairs_from_reference: bool = False,
    ) -> Errors:
        """Relative pose error; see `turtlewire.trajectory.rpe`."""
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

    def plot(self, relation: str = "trans_part", plane: str = "xy") -> Plot:
        """Return the path of the estimate, coloured by its APE, on the dashed reference."""
        return plot_error_path(self.reference, self.estimate, self.ape(relation), plane)

    def _repr_html_(self) -> str:
        return f"<pre>{escape(self.table())}</pre>\n{self.plot().svg}"

    def table(self, relation: str = "trans_part") -> str:
        """The statistics of the APE as evo prints them, with the alignment in the heading."""
        errors = self.ape(relation)
        unit = f" ({errors.unit})" if errors.unit else ""
        scale = f", scale {self.alignment.scale:.6f}" if self.align == "sim3" else ""
        return f"APE {relation}{unit}, aligned: {self.align}{scale}\n\n{errors.table()}"


def compare(
    reference: Trajectory,
    estimate: Trajectory,
    align: str = "none",
    *,
    max_diff_ns: int = _MAX_DIFF_NS,
    offset_ns: int = 0,
    poses_to_align: int | None = None,
) -> Comparison:
    """Associate two trajectories by time and align the estimate.

    Args:
        reference: The reference, for example ground truth.
        estimate: The estimate.
        align: ``none``, ``origin``, ``yaw``, ``se3`` or ``sim3``; see
            `turtlewire.trajectory.align`.
        max_diff_ns: Poses whose stamps differ by more do not belong together.
        offset_ns: Added to the stamps of the estimate, for clocks that differ.
        poses_to_align: Align by this number of first poses only; None for all.

    Returns:
        The pairs, for APE, RPE and plots.

    Raises:
        ValueError: No stamps match, only one has times, or the alignment is not possible.
    """
    if reference.timed != estimate.timed or (
        not reference.timed and len(reference) != len(estimate)
    ):
        raise ValueError(
            "a trajectory without times is compared with one of as many poses that has no times "
            f"either; these have {len(reference)} and {len(estimate)} poses (KITTI's times are "
            "read from <name>_times.txt)"
        )
    rows = associate(reference, estimate, max_diff_ns, offset_ns)
    # The stamps of a pair may repeat (one pose may be the nearest of two): the shorter one's do
    # not.
    short = reference if len(reference) <= len(estimate) else estimate
    stamps = short.stamps_ns[rows[0] if short is reference else rows[1]]
    first = _at(reference, rows[0], stamps)
    second = _at(estimate, rows[1], stamps)
    count = len(first) if poses_to_align is None else poses_to_align
    moved = alignment.align(first[:count], second[:count], align)
    return Comparison(first, moved.apply(second), align, moved)


def _at(trajectory: Trajectory, rows: object, stamps: object) -> Trajectory:
    return Trajectory(
        stamps,  # type: ignore[arg-type]
        trajectory.poses[rows],  # type: ignore[call-overload]
        trajectory.frame_id,
        trajectory.child_frame_id,
        trajectory.gaps,
    )
