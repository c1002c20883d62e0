"""`ros2 lifecycle`, `ros2 component` and `ros2 param` with nodes that answer."""

import subprocess
import sys

import pytest
from tests.programs import ROS2, offered

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
    command = [*ROS2, *words]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=840)
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


# `ros2 component` with a container of Python nodes.

MODULE = """
from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.get_logger().info(f"speed {self.declare_parameter('speed', 1).value}")
"""


@pytest.fixture
def component(run, tmp_path):
    (tmp_path / "some_module.py").write_text(MODULE)
    environment = {"PYTHONPATH": str(tmp_path)}

    def start(*words):
        return run(*ROS2, "component", *words, environment=environment)

    return start


@pytest.fixture
def container(run, tmp_path, component):
    words = ("-m", "rclpy_components.component_container")
    run(sys.executable, *words, environment={"PYTHONPATH": str(tmp_path)})
    listed = ""
    while "/ComponentManager" not in listed:
        verb = component("list", "--spin-time", "0.5")
        assert verb.wait() == 0
        listed = verb.text


def done(verb, status=0):
    assert verb.wait() == status
    return verb.text


@pytest.mark.usefixtures("container")
def test_a_node_is_loaded_listed_and_unloaded(component):
    load = ("load", "/ComponentManager", "some_module", "some_module.Talker")
    options = ("-n", "other", "--node-namespace", "/ns", "-p", "speed:=3")
    told = "Loaded component 1 into '/ComponentManager' container node as '/ns/other'"
    assert done(component(*load, *options)) == told
    assert done(component(*load, "-q")) == "2"
    assert done(component("list")) == "/ComponentManager\n  1  /ns/other\n  2  /talker"
    assert done(component("list", "/ComponentManager")) == "1  /ns/other\n2  /talker"
    assert done(component("list", "--containers-only")) == "/ComponentManager"
    told = "Unloaded component 1 from '/ComponentManager' container node"
    assert done(component("unload", "/ComponentManager", "1")) == told
    assert done(component("unload", "/ComponentManager", "1"), status=1) == (
        "Failed to unload component 1 from '/ComponentManager' container node\n"
        "    No node found with unique_id: 1"
    )


def test_a_container_that_is_not_there(component):
    told = done(component("unload", "/Nobody", "1"), status=1)
    assert told == "Unable to find container node '/Nobody'"


def test_a_container_of_its_own(component):
    words = ("some_module", "some_module.Talker", "-p", "speed:=7")
    verb = component("standalone", *words)
    verb.wait_for("speed 7")
    verb.wait_for("^Loaded component 1 as '/talker'$")
    verb.process.terminate()
    assert verb.wait() == 2
    told = done(component("standalone", "some_module", "some_module.Nobody"), status=1)
    assert "Failed to load component: AttributeError: " in told
    told = done(component("standalone", "std_msg", "some_module.Talker"), status=1)
    assert "Package 'std_msg' not found. Did you mean: std_msgs" in told
    assert told.endswith(
        "Failed to load component: Could not find requested resource in ament index"
    )


def test_registered_types(component, tmp_path, monkeypatch):
    folder = tmp_path / "share" / "ament_index" / "resource_index" / "rclcpp_components"
    folder.mkdir(parents=True)
    (folder / "some_package").write_text("some::Talker;lib/libtalker.so\nsome::Other;lib/libo.so\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    # Behind them are those of the packages that are installed.
    assert done(component("types")).startswith("some_package\n  some::Talker\n  some::Other")
    assert done(component("types", "some_package")) == "some::Talker\nsome::Other"
    told = done(component("types", "nobody"), status=1)
    assert told == "No components registered for package 'nobody'"


# `ros2 param get` and `set` of several parameters.

NODES = """
import rclpy
from rclpy.executors import SingleThreadedExecutor
rclpy.init()
executor = SingleThreadedExecutor()
for name, parameters in {"a": {"speed": 20.0, "on": True}, "b": {"speed": 3}, "c": {}}.items():
    node = rclpy.create_node(name)
    for parameter, value in parameters.items():
        node.declare_parameter(parameter, value)
    executor.add_node(node)
print("ready", flush=True)
executor.spin()
"""


@pytest.fixture
def nodes(run):
    run(sys.executable, "-c", NODES).wait_for("ready")


def told(capsys, words, status=0):
    # The default limit of five seconds is too short on a machine with more tests than cores.
    assert main(["param", *words.split(), "--timeout", "60"]) == status
    return capsys.readouterr()


def test_several_parameters_of_a_node(nodes, capsys):
    text = "speed:\n  Double value is: 20.0\non:\n  Boolean value is: True\n"
    assert told(capsys, "get /a speed on") == (text, "")
    assert told(capsys, "get --hide-type /a on speed") == ("on: True\nspeed: 20.0\n", "")
    assert told(capsys, "get /a speed") == ("Double value is: 20.0\n", "")
    missing = "Parameter(s) 'on', 'sped' not available on node\nDid you mean: speed\n"
    assert told(capsys, "get /a on sped", 1) == ("", missing)


def test_a_parameter_of_all_nodes(nodes, capsys):
    text = "/a:\n  Double value is: 20.0\n/b:\n  Integer value is: 3\n"
    assert told(capsys, "get speed") == (text, "")
    assert told(capsys, "get on --hide-type") == ("/a: True\n", "")
    assert told(capsys, "get sped", 1) == ("", "Parameter 'sped' not set on any node\n")
    hint = "Parameter '/a' not set on any node\n/a is a node: also name one of its parameters\n"
    assert told(capsys, "get /a", 1) == ("", hint)


def test_several_parameters_are_set(nodes, capsys):
    text = "speed: Set parameter successful\non: Set parameter successful\n"
    assert told(capsys, "set /a speed 1.5 on false") == (text, "")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 1.5\n"
    out, err = told(capsys, "set /a speed fast on true")
    assert out == "on: Set parameter successful\n"
    assert err.startswith("speed: Setting parameter failed: Wrong parameter type, expected ")
    assert told(capsys, "set /a on true") == ("Set parameter successful\n", "")
    pairs = "Parameters must be provided as name/value pairs: name value [name value ...]."
    assert told(capsys, "set /a speed 1.0 on", 1) == ("", f"{pairs} Got 3 argument(s).\n")


def test_all_parameters_are_set_or_none(nodes, capsys):
    text = "Set parameters atomically successful\n"
    assert told(capsys, "set --atomic /a speed 2.5 on false") == (text, "")
    out, err = told(capsys, "set --atomic /a speed 9.5 on maybe")
    assert out == ""
    assert err.startswith("Setting parameters atomically failed: Wrong parameter type, expected ")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 2.5\n"


def test_completion_of_a_second_parameter(nodes):
    assert "on" in set().union(*(offered("ros2 param get /a speed o") for _ in range(3)))
