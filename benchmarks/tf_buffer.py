"""The transform buffer: single lookups, messages, batches, ingest, waiting."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator

from benchmarks import floors
from benchmarks.figures import Figure, Row, run_adapter

DEBIAN = "Debian tf2_py"
DEBIAN_MODULES = "rospy, tf2_py, geometry_msgs.msg, tf2_msgs.msg"
TITLE = "TF buffer (chain of 3 moving links at 1 kHz, 10 s; ingest per transform)"

# what, our case, Debian's case, NumPy's case, budget of DESIGN §4
CASES = [
    ("lookup, latest", "lookup latest", "lookup latest", "", "50x; < 230 ns (tf2's own C++ call)"),
    (
        "lookup, interpolated",
        "lookup interpolated",
        "lookup interpolated",
        "",
        "28x; < 340 ns (tf2's own C++ call)",
    ),
    ("lookup, 9 s back", "lookup 9 s back", "lookup 9 s back", "", "within 20 % of the recent one"),
    ("tf2_ros message, latest", "message latest", "lookup latest", "", "8x"),
    ("tf2_ros message, interpolated", "message interpolated", "lookup interpolated", "", "8x"),
    ("can_transform, interpolated", "can_transform", "can_transform", "", ""),
    ("failing lookup, caught", "failing lookup", "failing lookup", "", ""),
    (
        "batch of 1e5 random stamps, per item",
        "batch random",
        "lookup, random stamps",
        "batch random",
        "75x Debian, 15x NumPy",
    ),
    (
        "batch of 1e5 sorted stamps, per item",
        "batch sorted",
        "lookup, random stamps",
        "batch sorted",
        "",
    ),
    ("1e5 points, a stamp for each, per point", "points", "", "", ""),
    ("ingest, 1 transform a message", "ingest 1 a message", "ingest 1 a message", "", ""),
    ("ingest, 100 a message, hot", "ingest hot", "ingest hot", "", "100x"),
    ("ingest, 100 a message, 1e6 samples stored", "ingest cold", "ingest cold", "", "30x"),
    ("arrays in order, 1e5 samples, CPU per sample", "arrays of 100000", "", "", "20 ns"),
    ("arrays in order, 1e6 samples, CPU per sample", "arrays of 1000000", "", "", "20 ns"),
    ("wake-up of a waiting lookup", "wake-up of a waiting lookup", "", "", "median <= 100 µs"),
]


def rows() -> Iterator[Row]:
    """Measure, rival after rival, each in its own process."""
    ours = run_adapter(sys.executable, "turtlewire_buffer")
    debian = run_adapter("/usr/bin/python3", "debian_tf2_py", needs=DEBIAN_MODULES)
    numpy = run_adapter(sys.executable, "numpy_chain")
    others = os.environ.get("BENCHMARK_PYTHON", sys.executable)
    numba = run_adapter(others, "numba_chain", needs="numba")
    pytransform3d = run_adapter(others, "pytransform3d_chain", needs="pytransform3d")
    transform_tree = run_adapter(others, "transform_tree_chain", needs="tf_tree")
    for what, case, debian_case, numpy_case, budget in CASES:
        rivals = {DEBIAN: debian.get(debian_case), "NumPy": numpy.get(numpy_case)}
        rivals |= {"Numba": numba.get(case), "pytransform3d": pytransform3d.get(case)}
        rivals["transform-tree"] = transform_tree.get(case)
        yield Row(
            what,
            ours[case],
            {name: figure for name, figure in rivals.items() if figure},
            budget,
            floors.copying(int(case.rpartition(" ")[2])) if case.startswith("arrays") else None,
        )
    full = ours["memory"]
    yield Row(
        "memory per sample, full 10 s cache at 1 kHz",
        Figure(full.minimum, full.median, "B"),
        budget="<= 70 B",
    )
