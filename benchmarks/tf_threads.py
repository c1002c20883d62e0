"""Lookups of two threads on one buffer, with and without a GIL."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from benchmarks.figures import Row, run_adapter

if TYPE_CHECKING:
    from collections.abc import Iterator

TITLE = "TF buffer of two threads (per lookup of both; the ratio is that of lookups a second)"
#: Where scripts/free-threaded puts its Pythons.
FREE_THREADED = Path(__file__).parent.parent / "build" / "free-threaded"
CASES = {"latest": "lookup, latest", "interpolated": "interpolated", "batch": "batch, per item"}


def pythons() -> dict[str, str]:
    """The interpreters that are measured, by what they are."""
    found = {"GIL": sys.executable}
    for venv in sorted(FREE_THREADED.glob("*t")):
        found[f"no GIL, {venv.name}"] = str(venv / "bin" / "python")
    if named := os.environ.get("FREE_THREADED_PYTHON"):
        found["no GIL"] = named
    if len(found) == 1:
        print("without a GIL: left out; scripts/free-threaded sets one up", file=sys.stderr)
    return found


def rows() -> Iterator[Row]:
    """Measure, interpreter after interpreter, one and two threads in turns."""
    for kind, python in pythons().items():
        figures = run_adapter(python, "turtlewire_threads")
        for case, what in CASES.items():
            one, two = figures[f"{case} 1"], figures[f"{case} 2"]
            rate = f"{1e3 / one.minimum:.3g} and {1e3 / two.minimum:.3g} million a second"
            yield Row(f"{what}, {kind}: {rate}", two, {"one thread": one}, "1.7x without a GIL")
