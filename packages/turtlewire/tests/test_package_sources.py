"""Well-known packages that are missing: errors name what to clone."""

import sys

import pytest
from tests.programs import run_python

from turtlewire import msg
from turtlewire.errors import InterfaceError
from turtlewire.package_sources import pip_install, source_hint

NAV2 = (
    "nav2_msgs does not come with turtlewire. In the folder src of your workspace, type: "
    "git clone -b jazzy https://github.com/ros-navigation/navigation2; then, in the workspace: "
    "colcon build --packages-up-to nav2_msgs && source install/setup.bash"
)


@pytest.mark.parametrize("name", ["nav2_msgs", "nav2_msgs.action", "nav2_msgs/action/Spin"])
def test_the_hint_names_repository_and_branch(name):
    assert source_hint(name) == NAV2


@pytest.mark.parametrize(
    "package",
    [
        "ackermann_msgs",
        "controller_manager",
        "controller_manager_msgs",
        "irobot_create_msgs",
        "moveit_msgs",
        "nav2_simple_commander",
        "nmea_msgs",
        "px4_msgs",
        "rmf_building_map_msgs",
        "rmf_fleet_msgs",
        "rmf_task_msgs",
        "ros2controlcli",
    ],
)
def test_well_known_packages_have_a_source(package):
    assert f"--packages-up-to {package} " in source_hint(package)


def test_packages_of_ours_that_are_not_installed():
    hint = source_hint("cv_bridge")
    assert hint.startswith("cv_bridge comes with turtlewire-extras. ")
    assert hint.endswith(" -m pip install ./packages/turtlewire-extras")


@pytest.mark.skipif(sys.platform == "win32", reason="cmd has other quotes")
def test_the_command_of_pip_quotes_the_path_of_python(monkeypatch):
    monkeypatch.setattr("sys.executable", "/my venv/bin/python")
    assert pip_install() == "'/my venv/bin/python' -m pip install"


@pytest.mark.parametrize(
    "package", ["laser_geometry", "tf2_kdl", "nav2_bringup", "moveit_ros", "ros_gz_sim"]
)
def test_packages_that_need_a_ros_2(package):
    assert source_hint(package) == (
        f"{package} does not come with turtlewire. Run the programs that need it on a computer "
        "with ROS 2: its nodes and yours discover each other"
    )


@pytest.mark.parametrize("package", ["", "my_msgs", "nav2", "control_msgs", "vision_msgs"])
def test_other_packages_have_no_source(package):
    assert source_hint(package) == ""


def test_packages_that_come_with_turtlewire_have_no_source():
    assert [package for package in msg.interfaces() if source_hint(package)] == []


def test_an_unknown_interface_has_the_hint():
    with pytest.raises(InterfaceError, match="unknown interface 'nav2_msgs/action/Spin'") as caught:
        msg.get_action("nav2_msgs/action/Spin")
    assert caught.value.hint == NAV2


def last_lines(program):
    result = run_python(program, check=False)
    assert result.returncode == 1
    return result.stderr.splitlines()[-2:]


@pytest.mark.parametrize(
    "imports",
    [
        "from geometry_msgs.msg import PoseStamped\nfrom nav2_msgs.action import Spin",
        "import rclpy\nimport nav2_msgs",
        "from geometry_msgs.msg import Pose\nimport rclpy\nrclpy.init()\nimport nav2_msgs.msg",
        "import rclpy\nfrom geometry_msgs.msg import Pose\nimport nav2_msgs.msg",
    ],
)
def test_the_traceback_of_a_program_ends_with_the_hint(imports):
    pytest.importorskip("rclpy")
    assert last_lines(imports) == ["ModuleNotFoundError: No module named 'nav2_msgs'", NAV2]


@pytest.mark.parametrize("package", ["nav2_simple_commander", "controller_manager"])
def test_python_packages_have_the_hint(package):
    pytest.importorskip("rclpy")
    told = last_lines(f"import rclpy\nfrom {package} import robot_navigator")
    assert told == [f"ModuleNotFoundError: No module named '{package}'", source_hint(package)]


@pytest.mark.parametrize(
    ("failure", "last"),
    [
        ("import my_msgs", "ModuleNotFoundError: No module named 'my_msgs'"),
        ("raise ImportError('x', name='nav2_msgs')", "ImportError: x"),
    ],
)
def test_other_errors_have_no_hint(failure, last):
    pytest.importorskip("rclpy")
    assert last_lines(f"import rclpy\n{failure}")[-1] == last
