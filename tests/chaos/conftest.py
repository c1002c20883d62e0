"""Common parts of the chaos tests: programs in separate processes, and how they may end.

Chaos tests are slow tests. Whatever happens to a process (kills, limits, a full disk, hostile
peers, a clock that jumps), it goes on, or it ends with a line that says why: it never crashes,
hangs or floods the terminal.
"""

import signal
import sys
import textwrap

import pytest

#: How a crash shows in an exit status.
CRASHES = [-signal.SIGSEGV, -signal.SIGABRT, -signal.SIGBUS, -signal.SIGILL, -signal.SIGFPE]
#: Far more lines than any of the tests' programs should print.
FLOOD = 200


@pytest.fixture
def python(run):
    """Start Python source in a separate process, with arguments and `limits` (RLIMIT name: n)."""

    def start(source, *arguments, limits=None, **options):
        head = "".join(
            f"import resource; resource.setrlimit(resource.{name}, ({value}, {value}))\n"
            for name, value in (limits or {}).items()
        )
        source = head + textwrap.dedent(source)
        # A limit on files would truncate .pyc files, which later programs could not read.
        environment = {"PYTHONDONTWRITEBYTECODE": "1"} if limits else {}
        return run(
            sys.executable, "-u", "-c", source, *arguments, environment=environment, **options
        )

    return start


@pytest.fixture
def ends_well():
    """Wait for a program's end: no crash, no flood; its exit status."""

    def check(program, timeout=120):
        status = program.wait(timeout)
        assert status not in CRASHES, program.text
        assert len(program.lines) < FLOOD, program.text
        return status

    return check
