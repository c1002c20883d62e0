"""Commands whose output cannot be written: the reader of the pipe has gone, or the disk is full."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.places import BIN, ROOT

from turtlewire.program import program
from turtlewire_ros.executables import executable_paths
from turtlewire_ros.prefix import own_prefix, package_names

COMMANDS = [
    "turtlewire --help",
    "turtlewire --version",
    "turtlewire doctor",
    "turtlewire frames --once --period 0.1",
    "turtlewire view --port 0",
    "turtlewire foxglove --port 0",
    "ros2",
    "ros2 topic --help",
    "ros2 topic list",
    "ros2 interface show geometry_msgs/msg/Twist",
    "ros2 pkg executables",
    "ros2 doctor --report",
    "ros2 launch turtlesim multisim.launch.py --show-args",
    "ros2 run turtlesim turtlesim_node --help",
    "check_urdf --help",
    "urdf_to_graphviz --help",
    "launch_test --help",
    "rviz2 --help",
    "tf2_ros/tf2_echo --help",
    "tf2_ros/tf2_monitor --period 0.1",
    "rmw_zenoh_cpp/rmw_zenohd",
    "xacro/xacro --help",
    "python -m turtlewire.msg --help",
    "python -m turtlewire.demo --help",
    "python -m ament_index_python.cli",
    "python tools/demo.py --help",
]
TOO_FULL = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="/dev/full is of Linux")


def words(command):
    """The command line; `PACKAGE/EXECUTABLE` is what `ros2 run` runs."""
    first, *others = command.split()
    package, _, executable = first.partition("/")
    if executable:
        paths = {Path(path).name: path for path in executable_paths(package)}
        return [sys.executable, paths[executable], *others]
    return [sys.executable if first == "python" else BIN / first, *others]


def ended(command, **streams):
    """The command as users run it, without variables that change what Python buffers."""
    unset = ("PYTHONUNBUFFERED", "PYTHONDONTWRITEBYTECODE")
    environment = {name: value for name, value in os.environ.items() if name not in unset}
    environment |= {"ROS_DISABLE_DAEMON": "1", "ZENOH_CONFIG_OVERRIDE": ANY_PORT}
    environment |= streams.pop("environment", {})
    return subprocess.run(
        command,
        cwd=ROOT,
        env=environment,
        stdin=subprocess.DEVNULL,
        text=True,
        timeout=120,
        check=False,
        **streams,
    )


ANY_PORT = 'listen/endpoints=["tcp/127.0.0.1:0"]'


@pytest.fixture
def closed_pipe():
    """A pipe that nobody reads any more."""
    reader, writer = os.pipe()
    os.close(reader)
    yield writer
    os.close(writer)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_reader_that_has_gone_ends_a_command_as_it_ends_git(command, closed_pipe):
    done = ended(words(command), stdout=closed_pipe, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (141, "")


@TOO_FULL
@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk_is_one_line(command):
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = ended(words(command), stdout=full, stderr=subprocess.PIPE)
    assert done.returncode == 1
    (line,) = done.stderr.splitlines()
    assert line.endswith(": write error: No space left on device")


@TOO_FULL
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_each_way_of_buffering_fails_in_the_same_way(unbuffered, closed_pipe):
    environment = {"PYTHONUNBUFFERED": unbuffered}
    command = words("turtlewire --version")
    done = ended(command, environment=environment, stdout=closed_pipe, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (141, "")
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = ended(command, environment=environment, stdout=full, stderr=subprocess.PIPE)
    said = "turtlewire: write error: No space left on device\n"
    assert (done.returncode, done.stderr) == (1, said)


def test_an_error_that_nobody_reads_ends_quietly(closed_pipe):
    done = ended(words("ros2 topic nonsense"), stdout=closed_pipe, stderr=closed_pipe)
    assert done.returncode == 141


def test_output_that_can_be_written_comes_out_whole():
    done = ended(words("ros2 interface show geometry_msgs/msg/Twist"), stdout=subprocess.PIPE)
    assert done.returncode == 0
    assert done.stdout.count("\n") == 9
    assert done.stdout.endswith("float64 z\n")


IN_A_THREAD = """
import sys, threading
from turtlewire.program import program
@program
def main():
    def write():
        print("a line", flush=True)
    try:
        threading.Thread(target=write).start()
        threading.Event().wait()
    finally:
        print("cleaned up", file=sys.stderr)
sys.exit(main())
"""


def test_a_write_in_another_thread_ends_a_main_thread_that_waits(closed_pipe):
    done = ended([sys.executable, "-c", IN_A_THREAD], stdout=closed_pipe, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (141, "cleaned up\n")


@pytest.mark.parametrize("raised", ["SystemExit(3)", "KeyError('a fault of the program')"])
def test_other_ends_stay_as_they_are(raised):
    code = f"from turtlewire.program import program\n@program\ndef main(): raise {raised}\nmain()"
    done = ended([sys.executable, "-c", code], stderr=subprocess.PIPE)
    assert done.returncode == (3 if "3" in raised else 1)
    assert ("a fault of the program" in done.stderr) == ("KeyError" in raised)


def test_captured_output_is_left_alone(capsys):
    assert program(lambda: print("seen") or 7)() == 7
    assert capsys.readouterr().out == "seen\n"


def test_each_executable_of_this_distribution_ends_so():
    home = own_prefix()
    ours = [name for name, prefix in package_names().items() if prefix == home]
    paths = [Path(path) for name in ours for path in executable_paths(name) or ()]
    libexec = [path for path in paths if path.parent.parent == Path(home) / "lib"]
    assert len(libexec) > 50
    for path in libexec:
        text = path.read_text(encoding="utf-8")
        assert re.search(r'sys\.exit\(run_executable\("[\w.]+:\w+"\)\)', text), path


INTERRUPTED = """
import os, signal, weakref

class Module:
    pass

module = Module()
# Python drops what is raised in here, as at the end of an import.
end = weakref.ref(module, lambda _: os.kill(os.getpid(), signal.SIGINT))
del module

def main():
    return 7
"""


@pytest.mark.skipif(sys.platform == "win32", reason="a process of Windows has no signal")
@pytest.mark.parametrize(("before", "status"), [("SIG_IGN", 7), ("default_int_handler", -2)])
def test_ctrl_c_at_the_end_of_an_import_ends_an_executable(tmp_path, before, status):
    (tmp_path / "a_node.py").write_text(INTERRUPTED)
    code = f"import signal; signal.signal(signal.SIGINT, signal.{before})\n"
    code += "import sys; from turtlewire.program import run_executable\n"
    code += "sys.exit(run_executable('a_node:main'))"
    environment = {"PYTHONPATH": str(tmp_path)}
    done = ended([sys.executable, "-c", code], environment=environment, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (status, "")
