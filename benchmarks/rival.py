"""Runs the adapter of a rival in its own process."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from benchmarks.figures import Figure

ADAPTERS = Path(__file__).parent / "rivals"


def run_adapter(interpreter: str, adapter: str, *, needs: str = "") -> dict[str, Figure]:
    """The figures by case; none, and a line on stderr, if the interpreter lacks the module that the rival ``needs``."""
    if (
        needs
        and subprocess.run(
            [interpreter, "-c", f"import {needs}"], capture_output=True, check=False
        ).returncode
        != 0
    ):
        print(f"{adapter}: {interpreter} has no module {needs}, left out", file=sys.stderr)
        return {}
    run = subprocess.run(
        [interpreter, str(ADAPTERS / f"{adapter}.py")],
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    return {case: Figure(*values) for case, values in json.loads(run.stdout).items()}
