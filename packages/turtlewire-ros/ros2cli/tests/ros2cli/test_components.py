"""`ros2 component` with a container of Python nodes."""

import sys

import pytest

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"

MODULE = """
from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.get_logger().info(f"speed {self.declare_parameter('speed', 1).value}")
"""


@pytest.fixture
def ros2(run, tmp_path):
    (tmp_path / "some_module.py").write_text(MODULE)
    environment = {"PYTHONPATH": str(tmp_path)}

    def start(*words):
        return run(sys.executable, "-c", ROS2, "component", *words, environment=environment)

    return start


@pytest.fixture
def container(run, tmp_path, ros2):
    words = ("-m", "rclpy_components.component_container")
    run(sys.executable, *words, environment={"PYTHONPATH": str(tmp_path)})
    listed = ""
    while "/ComponentManager" not in listed:
        verb = ros2("list", "--spin-time", "0.5")
        assert verb.wait() == 0
        listed = verb.text


def done(verb, status=0):
    assert verb.wait() == status
    return verb.text


@pytest.mark.usefixtures("container")
def test_a_node_is_loaded_listed_and_unloaded(ros2):
    load = ("load", "/ComponentManager", "some_package", "some_module.Talker")
    options = ("-n", "other", "--node-namespace", "/ns", "-p", "speed:=3")
    told = "Loaded component 1 into '/ComponentManager' container node as '/ns/other'"
    assert done(ros2(*load, *options)) == told
    assert done(ros2(*load, "-q")) == "2"
    assert done(ros2("list")) == "/ComponentManager\n  1  /ns/other\n  2  /talker"
    assert done(ros2("list", "/ComponentManager")) == "1  /ns/other\n2  /talker"
    assert done(ros2("list", "--containers-only")) == "/ComponentManager"
    told = "Unloaded component 1 from '/ComponentManager' container node"
    assert done(ros2("unload", "/ComponentManager", "1")) == told
    assert done(ros2("unload", "/ComponentManager", "1"), status=1) == (
        "Failed to unload component 1 from '/ComponentManager' container node\n"
        "    No node found with unique_id: 1"
    )


def test_a_container_that_is_not_there(ros2):
    told = done(ros2("unload", "/Nobody", "1"), status=1)
    assert told == "Unable to find container node '/Nobody'"


def test_a_container_of_its_own(ros2):
    words = ("some_package", "some_module.Talker", "-p", "speed:=7")
    verb = ros2("standalone", *words)
    verb.wait_for("speed 7")
    verb.wait_for("^Loaded component 1 as '/talker'$")
    verb.process.terminate()
    assert verb.wait() == 2
    told = done(ros2("standalone", "some_package", "some_module.Nobody"), status=1)
    assert "Failed to load component: AttributeError: " in told


def test_registered_types(ros2, tmp_path, monkeypatch):
    folder = tmp_path / "share" / "ament_index" / "resource_index" / "rclcpp_components"
    folder.mkdir(parents=True)
    (folder / "some_package").write_text("some::Talker;lib/libtalker.so\nsome::Other;lib/libo.so\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    # Behind them are those of the packages that are installed.
    assert done(ros2("types")).startswith("some_package\n  some::Talker\n  some::Other")
    assert done(ros2("types", "some_package")) == "some::Talker\nsome::Other"
    told = done(ros2("types", "nobody"), status=1)
    assert told == "No components registered for package 'nobody'"
