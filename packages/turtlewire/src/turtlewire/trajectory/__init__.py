"""Trajectories: out of transforms, from and to files, compared with each other.

::

    from turtlewire.bag import load_transforms
    from turtlewire.trajectory import compare, read_tum, sample_trajectory, write_tum

    buffer, report = load_transforms("my_bag")
    estimate = sample_trajectory(buffer, "map", "base_link")
    write_tum(estimate, "estimate.tum")
    print(compare(read_tum("ground_truth.tum"), estimate, "se3").table())

=============  =========================================================
module         what it holds
=============  =========================================================
`trajectory`   `Trajectory`: stamps, poses and gaps
`sampling`     `sample_trajectory`: the poses of a frame out of a buffer
`files`        TUM, KITTI, EuRoC and CSV
`comparison`   `compare`: association, alignment and errors in one call
`alignment`    nearest stamps; Umeyama's and others' alignment
`metrics`      APE, RPE and their statistics
`plots`        paths, positions, angles and speeds as pictures
`error_plots`  errors as pictures
`chart`        axes, lines and boxes as SVG
`pictures`     charts as PDF and PNG
=============  =========================================================
"""

from __future__ import annotations

from turtlewire.trajectory.alignment import ALIGNMENTS, Alignment, align, associate
from turtlewire.trajectory.chart import Plot
from turtlewire.trajectory.comparison import Comparison, compare
from turtlewire.trajectory.error_plots import (
    plot_box,
    plot_error_path,
    plot_errors,
    plot_histogram,
)
from turtlewire.trajectory.files import (
    read_csv,
    read_euroc,
    read_kitti,
    read_trajectory,
    read_tum,
    write_csv,
    write_euroc,
    write_kitti,
    write_trajectory,
    write_tum,
)
from turtlewire.trajectory.metrics import RELATIONS, Errors, Statistics, ape, rpe
from turtlewire.trajectory.plots import (
    plot_angles,
    plot_path,
    plot_positions,
    plot_speeds,
)
from turtlewire.trajectory.sampling import find_gaps, sample_trajectory
from turtlewire.trajectory.trajectory import Gap, Trajectory, as_stamps

__all__ = [
    "ALIGNMENTS",
    "RELATIONS",
    "Alignment",
    "Comparison",
    "Errors",
    "Gap",
    "Plot",
    "Statistics",
    "Trajectory",
    "align",
    "ape",
    "as_stamps",
    "associate",
    "compare",
    "find_gaps",
    "plot_angles",
    "plot_box",
    "plot_error_path",
    "plot_errors",
    "plot_histogram",
    "plot_path",
    "plot_positions",
    "plot_speeds",
    "read_csv",
    "read_euroc",
    "read_kitti",
    "read_trajectory",
    "read_tum",
    "rpe",
    "sample_trajectory",
    "write_csv",
    "write_euroc",
    "write_kitti",
    "write_trajectory",
    "write_tum",
]
