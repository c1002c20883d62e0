"""The tutorials' nodes under the name of their C++ package, and urdf_launch."""

import signal

import pytest
from tests.places import ROS2

import demo_nodes_cpp

ROBOT = """<?xml version="1.0"?>
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="tip" value="hand"/>
  <link name="base_link"/>
  <link name="${tip}"/>
  <joint name="j" type="continuous">
    <parent link="base_link"/><child link="${tip}"/><axis xyz="0 0 1"/>
  </joint>
</robot>
"""


@pytest.fixture
def ros2(run):
    return lambda *words, **options: run(ROS2, *words, **options)


def end(program, number=signal.SIGINT):
    program.signal_group(number)
    assert program.wait() == 0
    assert "Traceback" not in program.text


def test_talker_and_listener_of_the_tutorial(ros2):
    listener = ros2("run", "demo_nodes_cpp", "listener")
    talker = ros2("run", "demo_nodes_cpp", "talker", "--ros-args", "-r", "__node:=my_talker")
    talker.wait_for(r"^\[INFO\] \[[\d.]+\] \[my_talker\]: Publishing: 'Hello World: 1'$")
    listener.wait_for(r"^\[INFO\] \[[\d.]+\] \[listener\]: I heard: \[Hello World: \d\]$")
    end(talker)
    end(listener)


@pytest.mark.parametrize("client", ["add_two_ints_client", "add_two_ints_client_async"])
def test_the_service_adds(ros2, client):
    server = ros2("run", "demo_nodes_cpp", "add_two_ints_server")
    asked = ros2("run", "demo_nodes_cpp", client)
    asked.wait_for(r"\[add_two_ints_client\]: Result of add_two_ints: 5$")
    assert asked.wait() == 0
    server.wait_for("^a: 2 b: 3$")
    end(server)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_client_waits_for_the_service_until_a_signal(ros2, number):
    asked = ros2("run", "demo_nodes_cpp", "add_two_ints_client")
    asked.wait_for(r"\[add_two_ints_client\]: service not available, waiting again\.\.\.$")
    # To `ros2 run` alone, which passes it on: a second SIGTERM would come after the shutdown.
    asked.process.send_signal(number)
    assert asked.wait() == 0


def test_a_blackboard_holds_any_parameter(ros2):
    words = ("run", "demo_nodes_cpp", "parameter_blackboard", "--ros-args", "-p", "given:=3")
    board = ros2(*words)
    board.wait_for(r"'/parameter_blackboard' ready, and serving '\d+' parameters already!$")
    done = ros2("param", "set", "/parameter_blackboard", "new", "red")
    assert done.wait() == 0
    assert "Set parameter successful" in done.text
    for name, said in (("given", "Integer value is: 3"), ("new", "String value is: red")):
        got = ros2("param", "get", "/parameter_blackboard", name)
        assert got.wait() == 0
        assert got.text.strip() == said
    end(board)


@pytest.mark.parametrize(
    ("file", "says"),
    [
        ("talker_listener_launch.py", r"\[listener\]: I heard: \[Hello World"),
        ("add_two_ints_launch.py", r"Result of add_two_ints: 5"),
    ],
)
def test_launch_files_start_the_nodes(ros2, file, says):
    launched = ros2("launch", "demo_nodes_cpp", file)
    launched.wait_for(says)
    end(launched)


CONTAINERS = ("component_container", "component_container_isolated", "component_container_mt")
LAUNCH_FILE = """
from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    nodes = [
        ComposableNode(package="demo_nodes_cpp", plugin="demo_nodes_cpp::Talker", name="loud"),
        ComposableNode(package="demo_nodes_cpp", plugin="demo_nodes_cpp::Listener"),
    ]
    return LaunchDescription(
        [
            ComposableNodeContainer(
                name="box",
                namespace="",
                package="rclcpp_components",
                executable="component_container",
                composable_node_descriptions=nodes,
            )
        ]
    )
"""


def test_the_components_are_listed(ros2):
    listed = ros2("component", "types", "demo_nodes_cpp")
    assert listed.wait() == 0
    components = listed.text.split()
    assert components == [f"demo_nodes_cpp::{name}" for name in demo_nodes_cpp.__all__]
    listed = ros2("pkg", "executables", "rclcpp_components")
    assert listed.wait() == 0
    assert listed.text.split()[1::2] == sorted(CONTAINERS)


@pytest.mark.parametrize("executable", CONTAINERS)
def test_a_container_loads_the_components(ros2, executable):
    container = ros2("run", "rclcpp_components", executable)
    seen = ""
    while "/ComponentManager" not in seen:
        listed = ros2("component", "list", "--spin-time", "0.5")
        assert listed.wait() == 0
        seen = listed.text
    load = ("component", "load", "/ComponentManager", "demo_nodes_cpp")
    loaded = ros2(*load, "demo_nodes_cpp::Talker", "-r", "__node:=loud")
    assert loaded.wait() == 0, loaded.text
    container.wait_for(r"\[loud\]: Publishing: 'Hello World: 1'$")
    missing = ros2(*load, "demo_nodes_cpp::ClientNode")
    assert missing.wait() == 1
    assert missing.text == (
        "Failed to load component: Failed to find class with the requested plugin name."
    )
    container.wait_for("demo_nodes_cpp has Listener, ParameterBlackboard, ServerNode, Talker$")
    end(container)


def test_a_launch_file_of_cpp_components_runs(ros2, tmp_path):
    (tmp_path / "box_launch.py").write_text(LAUNCH_FILE)
    launched = ros2("launch", tmp_path / "box_launch.py")
    launched.wait_for(r"\[loud\]: Publishing: 'Hello World: 1'$")
    launched.wait_for(r"\[listener\]: I heard: \[Hello World: \d\]$")
    end(launched)


@pytest.fixture
def robot_package(tmp_path, monkeypatch):
    """A prefix with the package `my_robot`, in a folder with a space."""
    prefix = tmp_path / "my prefix"
    marker = prefix / "share/ament_index/resource_index/packages/my_robot"
    urdf = prefix / "share/my_robot/urdf/r.urdf.xacro"
    for path, text in ((marker, ""), (urdf, ROBOT)):
        path.parent.mkdir(parents=True)
        path.write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    return ("urdf_package:=my_robot", "urdf_package_path:=urdf/r.urdf.xacro")


def test_urdf_launch_publishes_the_frames_of_a_robot(ros2, robot_package):
    launched = ros2("launch", "urdf_launch", "description.launch.py", *robot_package)
    launched.wait_for("got segment hand|Robot initialized")
    got = ros2("param", "get", "/robot_state_publisher", "robot_description")
    assert got.wait() == 0
    assert '<link name="hand"' in got.text
    end(launched)


def test_urdf_launch_shows_what_it_needs(ros2):
    shown = ros2("launch", "urdf_launch", "display.launch.py", "--show-args")
    assert shown.wait() == 0
    for name in ("urdf_package", "urdf_package_path", "rviz_config", "jsp_gui"):
        assert f"'{name}':" in shown.text


def test_urdf_launch_displays_a_robot(ros2, robot_package, monkeypatch):
    monkeypatch.setenv("BROWSER", "true")  # opens nothing
    launched = ros2("launch", "urdf_launch", "display.launch.py", "jsp_gui:=false", *robot_package)
    for process in ("robot_state_publisher", "joint_state_publisher", "rviz2"):
        launched.wait_for(rf"\[INFO\] \[{process}-\d\]: process started with pid")
    echo = ros2("topic", "echo", "--once", "/tf", "tf2_msgs/msg/TFMessage")
    assert echo.wait() == 0
    assert "child_frame_id: hand" in echo.text
    end(launched)
