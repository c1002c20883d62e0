"""The guardian ends its family; tests/chaos/test_processes.py shows it behind real commands."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

from turtlewire_ros.process_guardian import FAMILIES

#: The first look sees nobody, as when a process began during it.
LOOK_THAT_MISSES = """
from turtlewire_ros import process_guardian
looks = [process_guardian._look] * 100 + [lambda family: []]
process_guardian._look = lambda family: looks.pop()(family)
process_guardian.guard("ours")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows another's environment")
def test_a_process_that_a_look_missed_is_asked_to_end():
    environment = {**os.environ, FAMILIES: "outer:ours"}
    with subprocess.Popen(["sleep", "1000"], env=environment) as member:
        guardian = [sys.executable, "-c", LOOK_THAT_MISSES]
        done = subprocess.run(guardian, stdin=subprocess.DEVNULL, check=False)
        member.kill()
    assert done.returncode == 0
    assert member.returncode == -signal.SIGTERM  # it came first
