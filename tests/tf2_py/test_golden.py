"""Every answer of the real Jazzy tf2_py, texts included, on both cores."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

GOLDEN = Path(__file__).parents[1] / "golden" / "tf2"
ANSWERS, TEXTS = 24969, 12589


@pytest.mark.parametrize("core", ["native", "python"])
def test_all_answers_equal(core: str) -> None:
    if core == "native":
        pytest.importorskip("turtlewire._native", reason="the compiled core is not built here")
    command = [
        sys.executable,
        str(GOLDEN / "check.py"),
        str(GOLDEN / "dev.jsonl.gz"),
        "--texts",
        "--allow-subclass",
    ]
    run = subprocess.run(
        command,
        env={**os.environ, "TURTLEWIRE_CORE": core},
        capture_output=True,
        text=True,
        timeout=840,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert (
        run.stdout.splitlines()[-1]
        == f"{ANSWERS} of {ANSWERS} answers equal (class/numbers), {TEXTS} texts equal"
    )
