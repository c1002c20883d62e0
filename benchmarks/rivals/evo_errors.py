"""evo: APE, RPE and Umeyama's alignment."""

import sys
import time
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
from benchmarks.bag_data import trajectories
from benchmarks.clock import report, summary

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # evo and what it imports warn of one another
    from evo.core import metrics
    from evo.core.geometry import umeyama_alignment
    from evo.core.trajectory import PoseTrajectory3D


def cpu(function, runs=3):
    figures = []
    for _ in range(runs):
        start = time.process_time_ns()
        function()
        figures.append(time.process_time_ns() - start)
    return summary(figures)


def errors(metric, pair):
    metric.process_data(pair)
    metric.get_all_statistics()


stamps, p, q, estimated_p, estimated_q = trajectories()
pair = tuple(
    PoseTrajectory3D(positions, turns[:, [3, 0, 1, 2]], stamps / 1e9)
    for positions, turns in ((p, q), (estimated_p, estimated_q))
)
whole = metrics.PoseRelation.full_transformation
part = metrics.PoseRelation.translation_part
for each in pair:  # evo computes the matrices of poses once; they are in no figure
    _ = each.poses_se3
report(
    {
        "ape": cpu(lambda: errors(metrics.APE(part), pair)),
        "ape full": cpu(lambda: errors(metrics.APE(whole), pair)),
        "rpe": cpu(lambda: errors(metrics.RPE(part), pair)),
        "align": cpu(lambda: umeyama_alignment(estimated_p.T, p.T)),
    }
)
