"""Programs in processes of their own, and packages laid out as colcon lays them out."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

BIN = Path(sys.executable).parent


class Program:
    """A process in a session of its own, and what it prints, line by line with the time of arrival."""

    def __init__(self, *command, environment=None):
        self.lines = []
        self._more = threading.Condition()
        self.process = subprocess.Popen(
            [str(part) for part in command],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            env={**os.environ, **(environment or {})},
            start_new_session=True,
        )
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            with self._more:
                self.lines.append((time.monotonic(), line.rstrip("\n")))
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

    def signal_group(self, signum):
        """Send a signal to all processes of the session, as a terminal does."""
        os.killpg(self.process.pid, signum)

    def wait(self, timeout=60):
        """Its exit status, after everything that it printed has been read."""
        status = self.process.wait(timeout)
        self._reader.join(timeout)
        return status

    def survivors(self):
        """Processes of its session that are still there (zombies have ended)."""
        found = []
        for stat in Path("/proc").glob("[0-9]*/stat"):
            try:
                state, _, _, session = stat.read_text().rpartition(")")[2].split()[:4]
            except (FileNotFoundError, ProcessLookupError):
                continue
            if int(session) == self.process.pid and state != "Z":
                found.append(stat.parent.name)
        return found

    def kill(self):
        if self.process.poll() is None or self.survivors():
            self.signal_group(signal.SIGKILL)
        self.wait()
        self.process.stdout.close()


@pytest.fixture
def run():
    programs = []

    def start(*command, environment=None):
        programs.append(Program(*command, environment=environment))
        return programs[-1]

    yield start
    for program in programs:
        program.kill()


@pytest.fixture
def workspace(tmp_path):
    """Lays an ament_python package out as `colcon build --symlink-install` does; the environment that sourcing it would set."""

    def build(source):
        name, prefix = source.name, tmp_path / "install" / source.name
        for folder in (f"lib/{name}", "share/ament_index/resource_index/packages"):
            (prefix / folder).mkdir(parents=True)
        (prefix / "share/ament_index/resource_index/packages" / name).touch()
        shutil.copytree(source, prefix / "share" / name, ignore=shutil.ignore_patterns("*.egg-info", "__pycache__"))
        for executable, module in re.findall(r"'?\"?(\w+) = ([\w.]+):main", (source / "setup.py").read_text()):
            script = prefix / "lib" / name / executable
            script.write_text(f"#!{sys.executable}\nimport sys\nfrom {module} import main\nsys.exit(main())\n")
            script.chmod(0o755)
        path = os.pathsep.join(part for part in (str(source), os.environ.get("PYTHONPATH")) if part)
        return {
            "AMENT_PREFIX_PATH": str(prefix),
            "PYTHONPATH": path,
            "PYTHONDONTWRITEBYTECODE": "1",
            "TURTLEWIRE_PORT": "0",
            "TURTLEWIRE_BROWSER": "0",
        }

    return build


@pytest.fixture
def turtles():
    """Sees where the turtles are, on the wire."""
    from turtlewire import msg, wire
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.qos import QoS

    class Turtles:
        def __init__(self):
            self.context = wire.open_context()
            self.node = self.context.create_node("turtles")
            self.poses = {}
            self.more = threading.Condition()
            pose = msg.get_message("turtlesim/msg/Pose")
            for name in ("turtle1", "turtle2"):
                type_id = TypeId("turtlesim/msg/Pose", msg.type_hash("turtlesim/msg/Pose"))
                self.node.create_subscription(
                    f"/{name}/pose", type_id, QoS(), lambda cdr, _, name=name: self._take(name, msg.deserialize(pose, cdr))
                )

        def _take(self, name, pose):
            with self.more:
                self.poses[name] = pose
                self.more.notify_all()

        def distance(self):
            first, second = self.poses["turtle1"], self.poses["turtle2"]
            return ((first.x - second.x) ** 2 + (first.y - second.y) ** 2) ** 0.5

        def wait_for(self, condition, timeout=60):
            with self.more:
                assert self.more.wait_for(condition, timeout), self.poses

    turtles = Turtles()
    yield turtles
    turtles.context.close()
