"""Whatever ends `ros2 run` or `ros2 launch`, no process that they started outlives them."""

import os
import signal
import sys
from pathlib import Path

import pytest
from tests.places import ROS2

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows whose descendant it is"),
]


#: A program with a child, which it does not stop. Both say that they are ready, each by a single
#: write: an unbuffered `print` makes two, and the other's may come in between.
OBEDIENT = """#!/usr/bin/env python3
import os, signal, subprocess, sys
ready = "import os; os.write(1, b'ready\\\\n')"
subprocess.Popen([sys.executable, "-c", ready + "; import signal; signal.pause()"])
exec(ready)
signal.pause()
"""
#: The same, but both ignore all signals that can be ignored, and the child has its own session.
STUBBORN = """#!/usr/bin/env python3
import os, signal, subprocess, sys
ignore = "import signal; [signal.signal(n, signal.SIG_IGN) for n in (1, 2, 3, 15)]"
ready = "import os; os.write(1, b'ready\\\\n')"
exec(ignore)
child = f"{ignore}; {ready}; signal.pause()"
subprocess.Popen([sys.executable, "-c", child], start_new_session=True)
exec(ready)
while True:
    signal.pause()
"""
#: The same in a shell that does not wait for its children.
SHELL = """#!/bin/sh
(setsid sh -c "echo ready; exec sleep 1000" &)
echo ready
exec sleep 1000
"""
PROGRAMS = {"obedient": OBEDIENT, "stubborn": STUBBORN, "shell": SHELL}

LAUNCH_FILE = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess

def generate_launch_description():
    options = dict(output="screen", sigterm_timeout=0.5, sigkill_timeout=0.5)
    return LaunchDescription([
        ExecuteProcess(cmd=["ros2", "run", "p", "obedient"], **options),
        ExecuteProcess(cmd=["{0}/obedient"], **options),
        ExecuteProcess(cmd=["{0}/stubborn"], **options),
        ExecuteProcess(cmd=["{0}/shell && true"], shell=True, **options),
    ])
"""


@pytest.fixture
def workspace(tmp_path):
    """A prefix with the package `p`, whose executables are the programs, and a launch file."""
    index = tmp_path / "share/ament_index/resource_index/packages"
    library = tmp_path / "lib/p"
    index.mkdir(parents=True)
    library.mkdir(parents=True)
    (index / "p").touch()
    for name, text in PROGRAMS.items():
        (library / name).write_text(text)
        (library / name).chmod(0o755)
    (tmp_path / "all.launch.py").write_text(LAUNCH_FILE.format(library))
    return tmp_path


@pytest.fixture
def start(run, workspace):
    """Runs `ros2` with the workspace, and waits until so many programs are ready."""

    def start_ros2(*words, ready, **options):
        path = f"{ROS2.parent}{os.pathsep}{os.environ['PATH']}"
        environment = {"AMENT_PREFIX_PATH": str(workspace), "PATH": path}
        program = run(ROS2, *words, environment=environment, cwd=workspace, **options)
        program.wait_for(r"ready\W*$", count=ready)
        return program

    return start_ros2


@pytest.mark.parametrize("name", ["obedient", "shell"])
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGHUP, signal.SIGINT, signal.SIGTERM])
def test_ros2_run_leaves_nothing(start, name, number):
    program = start("run", "p", name, ready=2)
    program.process.send_signal(number)
    assert program.wait() == (-number if number == signal.SIGKILL else 256 - number)
    program.wait_for_survivors()


def test_ros2_run_killed_leaves_no_program_that_ignores_signals(start):
    program = start("run", "p", "stubborn", ready=2)
    program.process.kill()
    program.wait()
    program.wait_for_survivors()


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGHUP, signal.SIGINT, signal.SIGTERM])
def test_ros2_launch_leaves_nothing(start, number):
    launch = start("launch", "./all.launch.py", ready=8)
    launch.process.send_signal(number)
    status = launch.wait()
    launch.wait_for_survivors()
    expected = {signal.SIGKILL: -signal.SIGKILL, signal.SIGINT: 0}
    assert status == expected.get(number, 1), launch.text


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_signal_to_the_whole_group_leaves_nothing(start, number):
    launch = start("launch", "./all.launch.py", ready=8)
    launch.signal_group(number)
    launch.wait()
    launch.wait_for_survivors()


@pytest.mark.parametrize(
    "words", [["run", "p", "obedient"], ["launch", "./all.launch.py"]], ids=["run", "launch"]
)
def test_a_terminal_that_closes_leaves_nothing(start, words):
    program = start(*words, ready=2 if words[0] == "run" else 8, terminal=True)
    program.process.kill()  # it holds the terminal
    program.process.wait()
    program.wait_for_survivors()


def test_leftover_processes_end_with_the_launch(start, workspace):
    launch_file = LAUNCH_FILE.partition("        ExecuteProcess")[0]
    launch_file += (
        "        ExecuteProcess(cmd=['sh', '-c', 'setsid sleep 1000 & echo ready']),\n])\n"
    )
    (workspace / "all.launch.py").write_text(launch_file)
    launch = start("launch", "./all.launch.py", "-a", ready=1)
    assert launch.wait() == 0
    assert launch.survivors() == []  # at once: the launch has waited for it


def test_the_family_survives_the_loss_of_its_guardian(start):
    """Without it the command still stops its own children."""
    program = start("run", "p", "obedient", ready=2)
    for pid in program.survivors():
        if b"process_guardian" in Path(f"/proc/{pid}/cmdline").read_bytes():
            os.kill(pid, signal.SIGKILL)
    program.process.send_signal(signal.SIGTERM)
    # Its grandchild lives on, and keeps what it prints open.
    assert program.process.wait(120) == 256 - signal.SIGTERM
