"""Decoded messages of a robot's bag, against libraries that take turns with ours."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from benchmarks.figures import Row, run_adapter

TITLE = "Messages of all topics of a bag (CPU; the libraries take turns in one process)"

# what, case of the adapter, budget
CASES = [
    ("MCAP, decoded", "mcap decoded", "3x rosbags"),
    ("MCAP, bytes", "mcap bytes", ""),
    ("sqlite3, decoded", "sqlite3 decoded", "3x rosbags"),
    ("sqlite3, bytes", "sqlite3 bytes", ""),
    ("ROS 1, decoded", "ros1.bag decoded", "2x rosbags"),
    ("ROS 1, bytes (ours: converted to CDR)", "ros1.bag bytes", ""),
]


def rows() -> Iterator[Row]:
    """Measure; ``pip install mcap-ros2-support-fast`` adds that rival."""
    found = run_adapter(sys.executable, "bag_messages", needs="rosbags, mcap")
    for what, case, budget in CASES if found else ():
        rivals = {
            name: found[f"{case} {name}"]
            for name in ("rosbags", "mcap", "mcap-ros2-support-fast")
            if f"{case} {name}" in found
        }
        yield Row(what, found[f"{case} turtlewire"], rivals, budget)
