"""A measured figure, one row of the table, and the run of a rival's adapter."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

FACTORS = {"ns": 1.0, "µs": 1e3, "ms": 1e6, "s": 1e9}


@dataclass(frozen=True)
class Figure:
    """The result of repeated measurements.

    The minimum is the undisturbed cost; the median is the typical one.
    """

    minimum: float
    median: float
    unit: str = "ns"

    def text(self) -> str:
        if self.unit != "ns":
            return f"{self.minimum:.4g} / {self.median:.4g} {self.unit}"
        unit = next(
            unit
            for unit, factor in reversed(FACTORS.items())
            if self.minimum >= factor or unit == "ns"
        )
        return f"{self.minimum / FACTORS[unit]:.4g} / {self.median / FACTORS[unit]:.4g} {unit}"


@dataclass(frozen=True)
class Row:
    """A row of the table: a measurement, our figure, the rivals', the budget, the floor."""

    what: str
    ours: Figure
    rivals: dict[str, Figure] = field(default_factory=dict)
    budget: str = ""
    floor: Figure | None = None


ADAPTERS = Path(__file__).parent / "rivals"


def run_adapter(interpreter: str, adapter: str, *, needs: str = "") -> dict[str, Figure]:
    """The figures by case.

    None, and one line on stderr, if the interpreter cannot import the modules (separated by commas)
    that the rival ``needs``.
    """
    if needs:
        attempt = subprocess.run(
            [interpreter, "-c", f"import {needs}"], capture_output=True, text=True, check=False
        )
        if attempt.returncode != 0:
            reason = attempt.stderr.strip().splitlines()[-1]
            print(f"{adapter} is left out: {interpreter}: {reason}", file=sys.stderr)
            return {}
    run = subprocess.run(
        [interpreter, str(ADAPTERS / f"{adapter}.py")],
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    return {case: Figure(*values) for case, values in json.loads(run.stdout).items()}
