"""Bags into a buffer, writing bags, and errors of trajectories."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator

from benchmarks.figures import Row, run_adapter

TITLE = "Bags and trajectories (CPU of the process; peers in separate processes)"

# what, our case, the peers' case, budget
CASES = [
    ("1M messages of 1 transform, zstd MCAP, to buffer", "one", "one", "<= 0.30 s, floor 0.15"),
    ("the same, records walked in Python", "plain walk", "one", "<= 0.8 s"),
    ("100k messages of 20 transforms, to buffer", "several", "several", "<= 0.40 s"),
    ("writing 1M messages, zstd", "writing", "writing", "<= 0.8 s"),
    ("APE, translation, 100k poses", "ape", "ape", "50x evo"),
    ("APE, full, 100k poses", "ape full", "ape full", "50x evo"),
    ("RPE, translation, 1 frame, 100k poses", "rpe", "rpe", "20x evo"),
    ("Umeyama's alignment, 100k poses", "align", "align", ""),
]


def rows() -> Iterator[Row]:
    """Measure, peer after peer; rosbags and mcap only iterate over the bytes of messages."""
    with tempfile.TemporaryDirectory(prefix="turtlewire-bench-") as folder:
        os.environ["BENCHMARK_BAGS"] = folder
        ours = run_adapter(sys.executable, "turtlewire_bags")
        peers = {
            "rosbags, raw": run_adapter(sys.executable, "rosbags_bags", needs="rosbags"),
            "mcap, raw": run_adapter(sys.executable, "mcap_bags", needs="mcap"),
            "evo": run_adapter(sys.executable, "evo_errors", needs="evo"),
        }
    for what, case, other, budget in CASES:
        rivals = {name: found[other] for name, found in peers.items() if other in found}
        yield Row(what, ours[case], rivals, budget)
