"""Fixtures and helpers of all tests.

Every test process gets its own domain, log directory and loopback-only range; children
inherit them. The fixture ``run`` starts programs in separate processes; ``ros2_launch`` does so
with launch files, ``launch`` runs entities of launch files in the test's process. A test may be a
coroutine function.
"""

from __future__ import annotations

import asyncio
import contextlib
import gc
import inspect
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import threading
import time
import uuid
import zlib
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from tests.needs import CYCLONE_DDS, HAS_CYCLONE_DDS
from tests.places import ROS2

from turtlewire.testing import isolated_domain, reserved_domain

pytest_plugins = ["tests.no_skips"]

for_this_run = contextlib.ExitStack()
for_this_run.enter_context(isolated_domain())


# A shell starts what ends with `&` with SIGINT ignored, and `nohup` ignores SIGHUP; children
# inherit that. With handlers here, the children have the defaults again, as the tests expect.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers():
    """Return the number of processes for `-n auto`: two per core, because many tests wait."""
    return min(8, 2 * (os.cpu_count() or 1))


class ModuleOfCycloneDds(pytest.Module):
    """A module that cannot be imported where Cyclone DDS is missing."""

    def collect(self):
        """Skip it."""
        pytest.skip(CYCLONE_DDS, allow_module_level=True)


def pytest_pycollect_makemodule(module_path, parent):
    """Skip modules that import the bindings of Cyclone DDS where that is missing."""
    imports = "\nfrom turtlewire.wire.cyclone"
    if HAS_CYCLONE_DDS or imports not in module_path.read_text(encoding="utf-8"):
        return None
    return ModuleOfCycloneDds.from_parent(parent, path=module_path)


def pytest_collection_modifyitems(config, items):
    """Skip what needs another middleware; spread the files over the processes that share the tests.

    Each process begins with a block of neighbours. In the order of names, one block would hold most
    tests with a browser. The other processes would steal from it, and each would start a browser
    for every file that it takes tests from.
    """
    if not HAS_CYCLONE_DDS:
        for item in items:
            parameters = item.callspec.params if hasattr(item, "callspec") else {}
            # `in` would compare arrays, which are parameters of some tests, element by element.
            if any(
                isinstance(value, str) and value == "rmw_cyclonedds_cpp"
                for value in parameters.values()
            ):
                item.add_marker(pytest.mark.skip(reason=CYCLONE_DDS))
    if hasattr(config, "workerinput"):
        items.sort(key=lambda item: zlib.crc32(item.location[0].encode()))


def pytest_pyfunc_call(pyfuncitem):
    """Run a test that is a coroutine function in its own loop, for a minute at most."""
    if not inspect.iscoroutinefunction(pyfuncitem.obj):
        return None
    names = inspect.signature(pyfuncitem.obj).parameters
    arguments = {name: pyfuncitem.funcargs[name] for name in names}
    asyncio.run(asyncio.wait_for(pyfuncitem.obj(**arguments), 60))
    return True


def pytest_collection_finish():
    """Spare the garbage collector what stays to the end: all test modules and what they import."""
    gc.collect()
    gc.freeze()


def pytest_unconfigure():
    """Leave nothing behind."""
    for_this_run.close()


# The same examples in each run: what fails is due to the change at hand. `scripts/test
# --hypothesis-profile=fuzz` draws new ones. A busy machine is not a fault of the test.
settings.register_profile(
    "turtlewire", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("fuzz", settings.get_profile("turtlewire"), derandomize=False)
settings.load_profile("turtlewire")


CHROMIUM = shutil.which("chromium")
CHROMIUM_SHELL = shutil.which("chromium-headless-shell")
BROWSER_FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

# Runs a command in a terminal; what comes from its own input is typed there. Not with `pty.spawn`:
# it closes the terminal when Ctrl-C discards output that it is about to read.
IN_TERMINAL = """
import os, pty, sys, threading
pid, terminal = pty.fork()
if pid == 0:
    os.execvp(sys.argv[1], sys.argv[1:])
def type_keys():
    while keys := os.read(0, 1024):
        os.write(terminal, keys)
threading.Thread(target=type_keys, daemon=True).start()
while True:
    try:
        shown = os.read(terminal, 1024)
    except OSError:  # the command has ended
        break
    os.write(1, shown)
os._exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) & 255)
"""


class Program:
    """A process in a separate session, and what it prints, line by line with the time of arrival.

    With `terminal` it runs in its own terminal; :meth:`type` presses keys.
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

    def wait_for(self, pattern, count=1, timeout=120):
        """Return the first `count` matches of a regular expression, as soon as they arrive."""

        def found():
            return [match for _, line in list(self.lines) if (match := re.search(pattern, line))]

        with self._more:
            assert self._more.wait_for(
                lambda: len(found()) >= count or not self._reader.is_alive(), timeout
            ), self.text
        assert len(found()) >= count, self.text
        return found()[:count]

    def type(self, keys):
        """Press keys in its terminal; ``"\\x03"`` is Ctrl-C."""
        self.process.stdin.write(keys.encode())
        self.process.stdin.flush()

    def signal_group(self, signum):
        """Send a signal to all processes of its group, as a terminal does."""
        os.killpg(self.process.pid, signum)

    def wait(self, timeout=120):
        """Return the exit status, after reading all output."""
        status = self.process.wait(timeout)
        self._reader.join(timeout)
        return status

    def end(self, processes=None):
        """Press Ctrl-C; check that it ends well, leaves nothing, and how many processes end."""
        self.signal_group(signal.SIGINT)
        assert self.wait() == 0, self.text
        assert "Traceback" not in self.text, self.text
        assert self.survivors() == []
        if processes is not None:
            assert self.text.count("process has finished cleanly") == processes, self.text

    def survivors(self):
        """Processes that it started, directly or not, and that have not ended (zombies have)."""
        found = []
        for name in os.listdir("/proc"):
            if not name.isdigit():
                continue
            try:  # pathlib's glob would raise when a process ends meanwhile
                if self._mark.encode() in Path("/proc", name, "environ").read_bytes():
                    found.append(int(name))
            except (FileNotFoundError, ProcessLookupError, PermissionError):
                continue
        return found

    def wait_for_survivors(self, timeout=120):
        """Wait until all processes that it started have ended."""
        end = time.monotonic() + timeout
        while survivors := self.survivors():
            ended = select.poll()
            try:
                watched = os.pidfd_open(survivors[0])
            except ProcessLookupError:
                continue
            ended.register(watched, select.POLLIN)
            in_time = ended.poll(1000 * max(0.0, end - time.monotonic()))
            os.close(watched)
            assert in_time, (self.text, Path(f"/proc/{survivors[0]}/cmdline").read_bytes())

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
def other_domain():
    """Number of a free domain other than the one of this process."""
    with reserved_domain() as domain:
        yield domain


@pytest.fixture
def foreign_server():
    """Add servers to a node /stranger that announce no ``serviceid``, like servers on Fast DDS.

    They only read requests.
    """
    if not HAS_CYCLONE_DDS:
        pytest.skip(CYCLONE_DDS)
    from turtlewire import msg
    from turtlewire.wire import names, open_context
    from turtlewire.wire.base import TypeId
    from turtlewire.wire.cyclone.endpoint import EndpointSpec
    from turtlewire.wire.qos import QoS

    context = open_context(middleware="rmw_cyclonedds_cpp")
    node = context.create_node("stranger")

    def add(service, type_name):
        request = f"{type_name}_Request"
        type_id = TypeId(request, msg.type_hash(request))
        return node._subscription(
            EndpointSpec(service, names.request_topic(service), type_id, QoS())
        )

    yield add
    context.close()


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


@pytest.fixture(scope="module")
def chromium(request):
    """Starts Chromium. One for both kinds of browser: a thread has room for one Playwright.

    Files that are slow as a whole take the full Chromium, so that both programs are tested; others
    take the headless shell if it is installed, because it starts in a third of the time.
    """
    is_slow = request.node.get_closest_marker("slow") is not None
    path = CHROMIUM if is_slow else CHROMIUM_SHELL or CHROMIUM
    if path is None:
        pytest.skip("no chromium in PATH (Debian: apt install chromium)")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        yield lambda flags: playwright.chromium.launch(executable_path=path, args=flags)


@pytest.fixture(scope="module")
def browser(chromium):
    """A browser for the tests of a module; it draws nothing in 3D."""
    with contextlib.closing(chromium(BROWSER_FLAGS)) as browser:
        yield browser


@pytest.fixture(scope="module")
def browser_3d(chromium):
    """A browser that draws in 3D without a graphics card."""
    flags = [flag for flag in BROWSER_FLAGS if flag != "--disable-gpu"]
    flags += ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with contextlib.closing(chromium(flags)) as browser:
        yield browser


class Outcome:
    """The result of a launch: exit status, lines on the screen, its context and log folder."""

    def __init__(self, status, text, context, log_dir):
        self.status = status
        self.lines = text.splitlines()
        self.text = text
        self.context = context
        self.log_dir = Path(log_dir)

    @property
    def messages(self):
        """Messages of `LogInfo`, in order."""
        return [
            match[1]
            for line in self.lines
            if (match := re.fullmatch(r"\[INFO\] \[launch\.user\]: (.*)", line))
        ]

    @property
    def error(self):
        """Error that ended the launch."""
        head = "[ERROR] [launch]: Caught exception in launch (see debug for traceback): "
        (found,) = (line.removeprefix(head) for line in self.lines if line.startswith(head))
        return found


@pytest.fixture
def launch(capsys, monkeypatch, tmp_path):
    """Runs entities to their end; an exception of the launch itself is in `error`."""
    from launch import LaunchDescription, LaunchService, logging

    environment = dict(os.environ)
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))

    def start(*entities, **options):
        logging.reset()
        capsys.readouterr()
        service = LaunchService(**{"noninteractive": True, **options})
        service.include_launch_description(LaunchDescription(entities))
        status = service.run()
        return Outcome(
            status, capsys.readouterr().out, service.context, logging.launch_config.log_dir
        )

    yield start
    logging.reset()
    for name in set(os.environ) - set(environment):
        del os.environ[name]
    os.environ.update(environment)


@pytest.fixture
def ros2_launch(run, tmp_path):
    """Runs `ros2 launch` on a launch file in a separate process."""

    def start(content, *arguments, name="test.launch.py", **options):
        (tmp_path / name).write_text(content)
        return run(ROS2, "launch", f"./{name}", *arguments, cwd=tmp_path, **options)

    return start
