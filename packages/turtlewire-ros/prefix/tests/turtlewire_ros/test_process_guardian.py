"""The guardian ends its family; tests/chaos/test_processes.py shows it behind real commands."""

import os
import signal
import subprocess
import sys

import pytest

from turtlewire_ros.process_guardian import FAMILIES

#: The first search finds no process, as if the process had begun during it.
SEARCH_THAT_MISSES = """
from turtlewire_ros import process_guardian
searches = [process_guardian._search] * 100 + [lambda family: []]
process_guardian._search = lambda family: searches.pop()(family)
process_guardian.guard("ours")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows another's environment")
def test_a_process_that_the_first_search_missed_gets_sigterm():
    environment = {**os.environ, FAMILIES: "outer:ours"}
    with subprocess.Popen(["sleep", "1000"], env=environment) as member:
        guardian = [sys.executable, "-c", SEARCH_THAT_MISSES]
        done = subprocess.run(guardian, stdin=subprocess.DEVNULL, check=False)
        member.kill()
    assert done.returncode == 0
    assert member.returncode == -signal.SIGTERM  # it came first


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows another's environment")
def test_a_stopped_process_wakes_up_to_end():
    environment = {**os.environ, FAMILIES: "outer:ours"}
    command = 'trap "echo ended; exit 7" TERM; echo ready; while :; do read -r _ || exit 9; done'
    with subprocess.Popen(
        ["sh", "-c", command],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as member:
        assert member.stdout.readline() == "ready\n"
        member.send_signal(signal.SIGSTOP)
        os.waitid(os.P_PID, member.pid, os.WSTOPPED | os.WNOWAIT)
        guardian = "from turtlewire_ros.process_guardian import guard; guard('ours')"
        done = subprocess.run(
            [sys.executable, "-c", guardian], stdin=subprocess.DEVNULL, check=False
        )
        assert member.stdout.read() == "ended\n"
    assert (done.returncode, member.returncode) == (0, 7)
