"""Trajectories: sampled from transforms, read and written, compared with each other.

::

    import turtlewire
    from turtlewire.trajectory import Trajectory, compare

    estimate = turtlewire.Buffer.from_bag("my_bag").trajectory("map", "base_link")
    estimate.save("estimate.tum")
    print(compare(Trajectory.load("ground_truth.tum"), estimate, "se3").table())

=============  =========================================================
module         contents
=============  =========================================================
`trajectory`   `Trajectory`: stamps, poses and gaps
`stamps`       conversion of stamps, and gaps between them
`sampling`     the poses of a frame from a buffer
`files`        TUM, KITTI, EuRoC and CSV
`comparison`   `compare`: association, alignment and errors in one call
`alignment`    nearest stamps; alignment by Umeyama and others
`metrics`      APE, RPE and their statistics
`plots`        plots of paths, positions, angles and speeds
`error_plots`  plots of errors; `plot`: several trajectories or errors in one
`chart`        axes, lines and boxes as SVG
`pictures`     charts as PDF and PNG
=============  =========================================================
"""

from turtlewire.trajectory.alignment import Alignment
from turtlewire.trajectory.chart import Plot
from turtlewire.trajectory.comparison import Comparison, compare
from turtlewire.trajectory.error_plots import plot
from turtlewire.trajectory.metrics import PoseErrors, Statistics
from turtlewire.trajectory.stamps import Gap
from turtlewire.trajectory.trajectory import Trajectory

__all__ = [
    "Alignment",
    "Comparison",
    "Gap",
    "Plot",
    "PoseErrors",
    "Statistics",
    "Trajectory",
    "compare",
    "plot",
]
