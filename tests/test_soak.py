"""`scripts/soak` for a minute: the processes that stay neither grow nor end."""

from __future__ import annotations

import sys

import pytest
from tests.places import TOOLS

SOAK = TOOLS / "soak.py"


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="it measures with Linux's /proc")
def test_a_minute(run):
    program = run(sys.executable, SOAK, "--minutes", "1")
    assert program.wait(500) == 0, program.text
    (said,) = program.wait_for(r"^visitors: (\d+), of them killed: (\d+)$")
    come, killed = map(int, said.groups())
    assert killed >= come // 3


def test_invalid_times(run):
    for minutes in ("0", "-1", "nan"):
        program = run(sys.executable, SOAK, f"--minutes={minutes}")
        assert program.wait() == 2
        assert "--minutes is between 0.5 and 10000" in program.text
