"""pytransform3d's TemporalTransformManager: it interpolates by screw motion, and gives matrices.

Times count from the first sample.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import numpy as np
from clock import per_call, report
from pytransform3d.transform_manager import NumpyTimeseriesTransform, TemporalTransformManager
from world import FIRST, FRAMES, RECENT, SAMPLES, STEP, pose, random_stamps


def filled():
    manager = TemporalTransformManager()
    times = np.arange(SAMPLES, dtype=float) * STEP
    for link in range(3):
        poses = np.array([pose(link, i) for i in range(SAMPLES)])[:, [0, 1, 2, 6, 3, 4, 5]]
        manager.add_transform(
            FRAMES[link + 1], FRAMES[link], NumpyTimeseriesTransform(times, poses)
        )
    return manager


def main():
    names = {"lookup": filled().get_transform_at_time, "recent": float(RECENT - FIRST)}
    names["stamps"] = np.array(random_stamps(100_000), dtype=np.int64) - float(FIRST)
    names["sorted_stamps"] = np.sort(names["stamps"])
    figures = {"lookup interpolated": per_call('lookup("camera", "map", recent)', names)}
    for case, which in (("batch random", "stamps"), ("batch sorted", "sorted_stamps")):
        figures[case] = [
            value / 1e5 for value in per_call(f'lookup("camera", "map", {which})', names)
        ]
    report(figures)


if __name__ == "__main__":
    main()
