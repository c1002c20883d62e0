"""A measured figure, one row of the table, and the run of a rival's adapter."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FACTORS = {"ns": 1.0, "µs": 1e3, "ms": 1e6, "s": 1e9}


@dataclass(frozen=True)
class Figure:
    """The result of repeated measurements.

    The minimum is the undisturbed cost; the median is the typical one.
    """

    minimum: float
    median: float
    unit: str = "ns"

    @classmethod
    def of(cls, values: Sequence[float], unit: str = "ns", *, factor: float = 1.0) -> Figure:
        """Return the figure of measured values, each times a factor."""
        return cls(factor * min(values), factor * statistics.median(values), unit)

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


def on_loopback(domain: int, **more: str) -> dict[str, str]:
    """Return the environment of processes that find each other only on this host."""
    local = {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    return {**os.environ, **local, **more}


def printed(
    command: Sequence[str | Path],
    environment: Mapping[str, str] | None = None,
    timeout_s: float | None = None,
) -> Any:
    """Run a command and return what is in the JSON on the last line of its output."""
    done = subprocess.run(
        command, env=environment, stdout=subprocess.PIPE, check=True, timeout=timeout_s
    )
    return json.loads(done.stdout.splitlines()[-1])


def printed_by_pair(
    program: Sequence[str], server: str, asker: str, environment: Mapping[str, str]
) -> dict[str, float]:
    """Return the figures that two runs of a program print.

    ``server`` and ``asker`` are the last word of each command. When the asker has ended, the
    server's stdin is closed.
    """
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen([*program, server], env=environment, **pipes) as serving:
        try:
            asked = printed([*program, asker], environment, 120)
            served, _ = serving.communicate(timeout=60)
        finally:  # of one that waits for the other, which failed
            serving.kill()
    return {**json.loads(served or "{}"), **asked}


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
    cases = printed([interpreter, ADAPTERS / f"{adapter}.py"])
    return {case: Figure(*values) for case, values in cases.items()}
