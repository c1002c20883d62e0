"""Fields of a topic as NumPy arrays, against a loop over the messages of rosbags."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from benchmarks.figures import Row, run_adapter

TITLE = "Fields of a topic as NumPy arrays (CPU, opening included; in turns in one process)"


def rows() -> Iterator[Row]:
    """Measure each topic in each storage."""
    found = run_adapter(sys.executable, "bag_columns", needs="rosbags")
    for case in dict.fromkeys(name.rpartition(" ")[0] for name in found):
        budget = "20x" if case.startswith(("/imu", "/odom")) else ""
        rivals = {"rosbags, loop": found[f"{case} rosbags"]}
        if not budget:  # the arrays are views of copied messages
            rivals["copying their bytes"] = found[f"{case} copy"]
        yield Row(case, found[f"{case} turtlewire"], rivals, budget)
