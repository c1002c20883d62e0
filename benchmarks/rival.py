"""Runs the adapter of a rival in its own process."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from benchmarks.figures import Figure

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
