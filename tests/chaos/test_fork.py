"""fork() while other threads use a buffer: the child uses it, too."""

from __future__ import annotations

import os

import pytest
from tests.needs import COMPILED_CORE
from tests.programs import run_python

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no fork()")

PROGRAM = """
import os, sys, threading, warnings
import turtlewire

sys.setswitchinterval(0.0001)  # more changes of threads; the one that forks has its turn sooner

warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of fork() beside threads
buffer = turtlewire.Buffer()
pose = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
buffer.set_transform("a", "b", 1, *pose)
stop = threading.Event()

def write(child):
    stamp = 1
    while not stop.is_set():
        stamp += 10_000_000  # old samples go: memory that grows would make each fork slower
        buffer.set_transform("a", child, stamp, *pose)

def wait():
    while not stop.is_set():
        buffer.can_transform("a", "never", 1, timeout_ns=1_000_000)

threads = [threading.Thread(target=write, args=(f"c{i}",)) for i in range(3)]
threads += [threading.Thread(target=wait) for _ in range(2)]
for thread in threads:
    thread.start()
failures = 0
for _ in range(COUNT):
    child = os.fork()
    if child == 0:
        ok = buffer.can_transform("a", "b", 1)
        waiter = threading.Thread(target=buffer.can_transform, args=("a", "late", 0, 10**10))
        waiter.start()
        buffer.set_transform("a", "late", 1, *pose)
        waiter.join()
        other = turtlewire.Buffer()
        other.set_transform("a", "b", 1, *pose)
        os._exit(0 if ok and buffer._fault() == "" else 1)
    failures += os.waitpid(child, 0)[1] != 0
stop.set()
for thread in threads:
    thread.join()
print(failures, "failures")
"""


def failures(core: str, count: int) -> str:
    return run_python(
        PROGRAM.replace("COUNT", str(count)),
        timeout=840,
        env={**os.environ, "TURTLEWIRE_CORE": core},
    ).stdout


@pytest.mark.parametrize("core", ["native", "python"])
def test_fork(core: str) -> None:
    if core == "native":
        pytest.importorskip("turtlewire._native", reason=COMPILED_CORE)
    assert failures(core, 60) == "0 failures\n"
