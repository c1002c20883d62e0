"""`ros2 lifecycle` with a managed node."""

import subprocess
import sys

import pytest
from tests.programs import run_python

from ros2cli.main import main

NODE = """
import sys, threading
import rclpy
from rclpy.lifecycle import LifecycleNode
rclpy.init()
from rclpy.lifecycle import TransitionCallbackReturn
class Managed(LifecycleNode):
    def on_activate(self, state):
        return TransitionCallbackReturn.FAILURE
node = Managed("managed")
print("ready", flush=True)
threading.Thread(target=lambda: (sys.stdin.read(), rclpy.try_shutdown()), daemon=True).start()
try:
    rclpy.spin(node)
except (KeyboardInterrupt, rclpy.executors.ExternalShutdownException):
    pass
"""


@pytest.fixture
def managed():
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen([sys.executable, "-c", NODE], **pipes)
    assert process.stdout.readline() == b"ready\n"
    yield
    process.communicate(timeout=60)


def ros2(*words):
    """Run in a separate process, as rclpy's default context belongs to a process."""
    program = "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))"
    result = run_python(program, *words, check=False, timeout=840)
    return result.returncode, result.stdout, result.stderr


def test_a_managed_node_is_listed_and_changes_its_state(managed):
    assert ros2("lifecycle", "nodes") == (0, "/managed\n", "")
    assert ros2("lifecycle", "get", "/managed") == (0, "unconfigured [1]\n", "")
    assert ros2("lifecycle", "get") == (0, "/managed: unconfigured [1]\n", "")
    status, shown, _ = ros2("lifecycle", "list", "/managed")
    assert status == 0
    assert shown.startswith("- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n")
    assert ros2("lifecycle", "set", "/managed", "configure") == (
        0,
        "Transitioning successful\n",
        "",
    )
    assert ros2("lifecycle", "get", "managed") == (0, "inactive [2]\n", "")
    status, _, told = ros2("lifecycle", "set", "/managed", "configure")
    assert status == 1
    assert told.startswith("Unknown transition requested, available ones are:\n- ")


def test_without_managed_nodes(capsys):
    assert main(["lifecycle", "nodes", "-c"]) == 0
    assert capsys.readouterr().out == "0\n"
    assert ros2("lifecycle", "get", "/nope") == (1, "", "Node not found\n")


def test_a_transition_that_fails_is_no_error_of_the_command(managed):
    assert ros2("lifecycle", "set", "/managed", "configure")[0] == 0
    assert ros2("lifecycle", "set", "/managed", "activate") == (0, "", "Transitioning failed\n")
    assert ros2("lifecycle", "get", "/managed") == (0, "inactive [2]\n", "")


def test_all_transitions_come_in_the_order_of_ros_2(managed):
    status, shown, _ = ros2("lifecycle", "list", "-a", "/managed")
    numbers = [int(line.split("[")[1][:-1]) for line in shown.splitlines() if line[0] == "-"]
    assert status == 0
    assert numbers == [
        *(1, 10, 11, 12),
        *(2, 20, 21, 22),
        *(3, 30, 31, 32),
        *(4, 40, 41, 42),
        *(5, 6, 7, 50, 51, 52),
        *(60, 61, 62),
    ]


def test_hidden_nodes_are_managed_when_asked_for(run):
    node = run(sys.executable, "-c", NODE.replace('"managed"', '"_managed"'), terminal=True)
    node.wait_for("ready")
    assert ros2("lifecycle", "nodes") == (0, "", "")
    assert ros2("lifecycle", "nodes", "--include-hidden-nodes") == (0, "/_managed\n", "")
    assert ros2("lifecycle", "get", "/_managed") == (1, "", "Node not found\n")
    hidden = ros2("lifecycle", "get", "--include-hidden-nodes", "/_managed")
    assert hidden == (0, "unconfigured [1]\n", "")
