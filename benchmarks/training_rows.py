"""Rows of a training set from a bag, against the usual loop over the messages of rosbags."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from benchmarks.figures import Row, run_adapter

TITLE = (
    "Joint states, a frame's pose, commands and images of a bag at the same moments, as in "
    "examples/bag_to_lerobot (CPU, opening included; in turns in one process)"
)


def rows() -> Iterator[Row]:
    """Measure each storage."""
    found = run_adapter(sys.executable, "training_rows", needs="rosbags,av")
    for case in dict.fromkeys(name.rpartition(" ")[0] for name in found):
        rivals = {
            "rosbags, loop": found[f"{case} rosbags"],
            "rosbag2_py and tf2_py (ours), loop": found[f"{case} rosbag2_py"],
        }
        yield Row(case, found[f"{case} turtlewire"], rivals, "10x")
