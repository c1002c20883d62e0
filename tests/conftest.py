"""What all tests share.

Every test process gets a domain, a log directory and a loopback-only range of its own; children inherit them.
The fixture ``run`` starts programs in processes of their own.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import uuid
from pathlib import Path

import pytest
from hypothesis import settings

os.environ["ROS_DOMAIN_ID"] = str(1 + os.getpid() % 230)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
os.environ["ROS_LOG_DIR"] = tempfile.mkdtemp(prefix="turtlewire-test-log-")
os.environ.pop("RMW_IMPLEMENTATION", None)

settings.register_profile("turtlewire", deadline=None)
settings.load_profile("turtlewire")


# Runs a command in a terminal; what comes from its own input is typed there.
IN_TERMINAL = "import os, pty, sys; sys.exit(os.waitstatus_to_exitcode(pty.spawn(sys.argv[1:])))"


class Program:
    """A process in a session of its own, and what it prints, line by line with the time of arrival.

    With `terminal` it runs in a terminal of its own; :meth:`type` are the keys.
    """

    def __init__(self, *command, environment=None, cwd=None, terminal=False):
        self.lines = []
        self._more = threading.Condition()
        self._mark = f"TURTLEWIRE_TEST_PROGRAM={uuid.uuid4()}"
        words = [str(part) for part in command]
        self.process = subprocess.Popen(
            [sys.executable, "-c", IN_TERMINAL, *words] if terminal else words,
            stdin=subprocess.PIPE if terminal else subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={**os.environ, **(environment or {}), **dict([self._mark.split("=")])},
            cwd=cwd,
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            with self._more:
                self.lines.append((time.monotonic(), line.decode(errors="replace").rstrip("\r\n")))
                self._more.notify_all()
        with self._more:
            self._more.notify_all()

    @property
    def text(self):
        return "\n".join(line for _, line in self.lines)

    def wait_for(self, pattern, count=1, timeout=60):
        """The first `count` matches of a regular expression, as soon as they are there."""

        def found():
            return [match for _, line in list(self.lines) if (match := re.search(pattern, line))]

        with self._more:
            assert self._more.wait_for(lambda: len(found()) >= count or not self._reader.is_alive(), timeout), self.text
        assert len(found()) >= count, self.text
        return found()[:count]

    def type(self, keys):
        """Press keys in its terminal; ``"\\x03"`` is Ctrl-C."""
        self.process.stdin.write(keys.encode())
        self.process.stdin.flush()

    def signal_group(self, signum):
        """Send a signal to all processes of its group, as a terminal does."""
        os.killpg(self.process.pid, signum)

    def wait(self, timeout=60):
        """Its exit status, after everything that it printed has been read."""
        status = self.process.wait(timeout)
        self._reader.join(timeout)
        return status

    def survivors(self):
        """Processes that it started, directly or not, and that have not ended (zombies have)."""
        found = []
        for environ in Path("/proc").glob("[0-9]*/environ"):
            try:
                if self._mark.encode() in environ.read_bytes():
                    found.append(int(environ.parent.name))
            except (FileNotFoundError, ProcessLookupError, PermissionError):
                continue
        return found

    def kill(self):
        for pid in self.survivors():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
        self.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                pipe.close()


@pytest.fixture
def run():
    """Starts programs, and ends those that still run after the test."""
    programs = []

    def start(*command, **options):
        programs.append(Program(*command, **options))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()
