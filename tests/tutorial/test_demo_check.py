"""`scripts/demo --check` notices when something that the demo lives on is killed on the way."""

from __future__ import annotations

import os
import re
import signal
import sys
from pathlib import Path

import pytest

DEMO = Path(__file__).parents[2] / "scripts" / "demo.py"
VICTIMS = {
    "turtle_tf2_broadcaster-2": "a broadcaster has stopped",
    "turtle_tf2_broadcaster-3": "a broadcaster has stopped",
    "turtle_tf2_listener-4": "nothing heard of the listener's commands to turtle2",
    "turtlesim_node-1": "nothing heard of turtle[12]|a broadcaster has stopped|the listener's commands",
}


@pytest.fixture
def checks(run):
    """One check for each victim, all at once: each waits most of the time."""
    return {victim: run(sys.executable, DEMO, "--check") for victim in VICTIMS}


def test_it_fails_when_a_process_is_killed(checks):
    for victim, check in checks.items():
        log = Path(check.wait_for(r"what the processes say goes to (.*)$")[0][1])
        check.wait_for("turtle2 moves", timeout=90)
        pid = re.search(rf"\[{victim}\]: process started with pid \[(\d+)\]", log.read_text())[1]
        os.kill(int(pid), signal.SIGKILL)
    for victim, check in checks.items():
        assert check.wait() == 1, check.text
        assert re.search(VICTIMS[victim], check.text), check.text
        assert re.search(r"final distance [\d.]+ m, \d+ lookups", check.text), check.text
        assert check.survivors() == []
        assert "Traceback" not in check.text
