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


stamps, p, q, estimated_p, estimated_q = trajectories()


def made(positions, turns):
    """A new trajectory: evo computes and keeps the matrices of its poses when they are needed."""
    return PoseTrajectory3D(positions, turns[:, [3, 0, 1, 2]], stamps / 1e9)


def cpu(function, runs=3):
    figures = []
    for _ in range(runs):
        pair = made(p, q), made(estimated_p, estimated_q)
        start = time.process_time_ns()
        function(pair)
        figures.append(time.process_time_ns() - start)
    return summary(figures)


def errors(metric, pair):
    metric.process_data(pair)
    metric.get_all_statistics()


whole = metrics.PoseRelation.full_transformation
part = metrics.PoseRelation.translation_part
report(
    {
        "ape": cpu(lambda pair: errors(metrics.APE(part), pair)),
        "ape full": cpu(lambda pair: errors(metrics.APE(whole), pair)),
        "rpe": cpu(lambda pair: errors(metrics.RPE(part), pair)),
        "align": cpu(lambda _: umeyama_alignment(estimated_p.T, p.T)),
    }
)
