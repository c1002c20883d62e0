"""Unknown names.

The error line is that of ROS 2, and the nearest names follow on a separate line.
"""

import signal
import sys

import pytest
from tests.programs import ROS2

from ros2cli.main import main
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def errors(capsys, *words):
    """The lines on stderr of a command that fails."""
    try:
        status = main(list(words))
    except SystemExit as end:
        status = end.code
    assert status in (1, 2)
    return [
        line
        for line in capsys.readouterr().err.splitlines()
        if not line.startswith(("usage:", "      "))
    ]


@pytest.mark.parametrize(
    ("line", "message", "near"),
    [
        ("lauch",
            ("ros2: error: argument Call `ros2 <command> -h` for more detailed usage.: "
            "invalid choice: 'lauch'"), "launch"),
        ("topic eco",
            ("ros2 topic: error: argument Call `ros2 topic <command> -h` for more detailed "
            "usage.: invalid choice: 'eco'"), "echo"),
        ("topic list --includ-hidden",
            ("ros2 topic list: error: unrecognized arguments: "
            "--includ-hidden"), "--include-hidden-topics"),
        ("run turtlesm turtlesim_node", "Package 'turtlesm' not found", "turtlesim"),
        ("launch turtlesm x.launch.py",
            ("Package 'turtlesm' not found: \"package 'turtlesm' not found, "
            "searching: "), "turtlesim"),
        ("pkg prefix turtlesm", "Package not found", "turtlesim"),
        ("pkg xml turtlesm", "Package not found", "turtlesim"),
        ("pkg executables turtlesm", "Package 'turtlesm' not found", "turtlesim"),
        ("interface show Imu",
            "ValueError: Invalid name 'Imu'. Expected at least two parts", "sensor_msgs/msg/Imu"),
        ("topic pub /x Imu", "The passed message type is invalid", "sensor_msgs/msg/Imu"),
        ("interface show geometry_msgs/msg/Twst",
            "unknown interface 'geometry_msgs/msg/Twst'", "geometry_msgs/msg/Twist"),
        ("interface proto std_msgs/msg/Strng",
            ("AttributeError: module 'std_msgs.msg' has no attribute "
            "'Strng'"), "std_msgs/msg/String"),
        ("interface package geometry_msg", "Unknown package 'geometry_msg'", "geometry_msgs"),
        ("topic pub /x geometry_msgs/msg/Twits",
            "The passed message type is invalid", "geometry_msgs/msg/Twist"),
        ("topic echo /x geometry_msgs/msg/Twits",
            "The passed message type is invalid", "geometry_msgs/msg/Twist"),
        ("service call /x turtlesim/srv/Spwn",
            "The passed service type is invalid", "turtlesim/srv/Spawn"),
        ("action send_goal /x turtlesim/action/RotatAbsolute {}",
            "The passed action type is invalid", "turtlesim/action/RotateAbsolute"),
        ("service call /x turtlesim/srv/Spawn {nme:1}",
            "Failed to populate field: 'Spawn_Request' object has no attribute 'nme'", "name"),
    ],
)  # fmt: skip
def test_names_that_are_known_without_nodes(capsys, line, message, near):
    told, hint = errors(capsys, *(word.replace(":1", ": '1'") for word in line.split()))
    assert told.startswith(message)
    assert hint.removeprefix("Did you mean: ").split(", ")[0] == near


@pytest.mark.parametrize("command", ["control", "security"])
def test_commands_that_are_not_here(capsys, command):
    with pytest.raises(SystemExit, match="2"):
        main([command, "list"])
    (told,) = capsys.readouterr().err.splitlines()
    assert told.startswith(f"ros2 {command}: ")
    clone = "git clone -b jazzy https://github.com/ros-controls/ros2_control; "
    assert (clone in told) == (command == "control")
    assert ("RMW_IMPLEMENTATION=rmw_zenoh_cpp" in told) == (command == "security")


def test_unrelated_names_get_no_hint(capsys):
    assert len(errors(capsys, "zzzz")) == 1
    error, hint = errors(capsys, "pkg", "prefix", "zzzz")
    assert error == "Package not found"
    assert "Did you mean" not in hint


@pytest.fixture
def pose_publisher():
    context = open_context()
    node = context.create_node("turtlesim")
    node.create_publisher(
        "/turtle1/pose", TypeId("turtlesim/msg/Pose", "RIHS01_" + "0" * 64), QoS()
    )
    yield
    context.close()


@pytest.mark.usefixtures("pose_publisher")
def test_names_of_the_graph(capsys):
    hint = "Did you mean: /turtle1/pose"
    assert errors(capsys, "topic", "echo", "/turtel1/pose") == [
        hint,
        "Could not determine the type for the passed topic",
    ]
    assert errors(capsys, "topic", "type", "/turtel1/pose") == [hint]
    assert errors(capsys, "topic", "type", "/qqq") == ["Known topics: /turtle1/pose"]
    assert errors(capsys, "service", "type", "/qqq") == ["No node offers any service now"]
    assert errors(capsys, "action", "type", "/qqq") == ["No node offers any action now"]
    assert errors(capsys, "topic", "info", "/turtel1/pose") == [
        "Unknown topic '/turtel1/pose'",
        hint,
    ]
    assert errors(capsys, "node", "info", "/turtlsim") == [
        "Unable to find node '/turtlsim'",
        "Did you mean: /turtlesim",
    ]
    assert errors(capsys, "param", "get", "/turtlsim", "x") == [
        "Node not found",
        "Did you mean: /turtlesim",
    ]


@pytest.mark.usefixtures("pose_publisher")
def test_a_topic_that_is_nearly_right_where_the_type_is_given(run):
    for verb, topic, said in (
        ("pub -w 0", "/turtel1/pose", "Did you mean: /turtle1/pose\n"),
        ("echo", "/turtel1/pose", "Did you mean: /turtle1/pose\n"),
        ("pub -w 0", "/qqq", ""),
    ):
        words = f"topic {verb} {topic} turtlesim/msg/Pose".split()
        process = run(*ROS2, *words)
        process.wait_for("No node (subscribes|publishes)")
        process.signal_group(signal.SIGINT)
        process.wait()
        assert ("Did you mean" in process.text) == bool(said)
        assert said in process.text


@pytest.mark.parametrize("name", ["Twist", "Twits"])
def test_a_type_without_its_package(capsys, name):
    assert errors(capsys, "topic", "pub", "/x", name) == [
        "The passed message type is invalid",
        "Did you mean: geometry_msgs/msg/Twist",
    ]


@pytest.mark.parametrize(
    "line", ["topic pub /x", "topic echo /x", "service call /x", "action send_goal /x"]
)
def test_an_interface_without_its_python_package(capsys, tmp_path, monkeypatch, line):
    kind = {"topic": "msg", "service": "srv", "action": "action"}[line.split()[0]]
    package = tmp_path / "share/half_msgs"
    (tmp_path / "share/ament_index/resource_index/packages").mkdir(parents=True)
    (tmp_path / "share/ament_index/resource_index/packages/half_msgs").touch()
    (package / kind).mkdir(parents=True)
    text = "int32 x\n" + {"msg": "", "srv": "---\n", "action": "---\n---\n"}[kind]
    (package / kind / f"Half.{kind}").write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    _, hint = errors(capsys, *line.split(), f"half_msgs/{kind}/Half", *["{}"] * (kind == "action"))
    assert hint.startswith(f"half_msgs/{kind}/Half is defined, but Python cannot import half_msgs")


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("interface show nav2_msgs/action/Spin", "Unknown package 'nav2_msgs'"),
        ("interface package nav2_msgs", "Unknown package 'nav2_msgs'"),
        ("interface proto nav2_msgs/action/Spin", "ModuleNotFoundError: No module named"),
        ("pkg prefix nav2_msgs", "Package not found"),
        ("topic pub /x nav2_msgs/msg/Costmap", "The passed message type is invalid"),
        ("topic echo /x nav2_msgs/msg/Costmap", "The passed message type is invalid"),
        ("service call /x nav2_msgs/srv/SaveMap", "The passed service type is invalid"),
        ("service echo /x nav2_msgs/srv/SaveMap", "The service type 'nav2_msgs/srv/SaveMap' is"),
        ("action send_goal /x nav2_msgs/action/Spin {}", "The passed action type is invalid"),
    ],
)
def test_an_interface_package_to_clone(capsys, line, error):
    told, hint = errors(capsys, *line.split())
    assert told.startswith(error)
    assert hint.startswith("nav2_msgs does not come with turtlewire.")
    assert "git clone -b jazzy https://github.com/ros-navigation/navigation2" in hint


@pytest.mark.parametrize(
    ("line", "error", "repository"),
    [
        ("run controller_manager spawner", "Package 'controller_manager' not found",
            "ros-controls/ros2_control"),
        ("pkg prefix controller_manager", "Package not found", "ros-controls/ros2_control"),
        ("pkg prefix nav2_simple_commander", "Package not found", "ros-navigation/navigation2"),
    ],
)  # fmt: skip
def test_a_python_package_to_clone(capsys, line, error, repository):
    told, hint = errors(capsys, *line.split())
    assert told == error
    package = line.split()[2 if line.startswith("pkg") else 1]
    assert f"git clone -b jazzy https://github.com/{repository};" in hint
    assert f"colcon build --packages-up-to {package} && source install/setup.bash" in hint


def test_a_command_whose_package_is_cloned(capsys, tmp_path, monkeypatch):
    folder = tmp_path / "src/ros2_control/ros2controlcli"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>ros2controlcli</name></package>")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match="2"):
        main(["control", "list_controllers"])
    told = capsys.readouterr().err
    assert told.startswith("ros2 control: 'ros2controlcli' is in src/ros2_control/ros2controlcli, ")


def test_a_topic_whose_interface_package_is_to_be_cloned(capsys):
    context = open_context()
    type_id = TypeId("px4_msgs/msg/VehicleOdometry", "RIHS01_" + "0" * 64)
    context.create_node("px4").create_publisher("/fmu/out/vehicle_odometry", type_id, QoS())
    told, hint = errors(capsys, "topic", "echo", "/fmu/out/vehicle_odometry")
    context.close()
    assert told == "The message type 'px4_msgs/msg/VehicleOdometry' is invalid"
    assert "git clone -b main https://github.com/PX4/px4_msgs" in hint


def test_an_interface_package_that_is_cloned(capsys, tmp_path, monkeypatch):
    folder = tmp_path / "src/navigation2/nav2_msgs"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>nav2_msgs</name></package>")
    monkeypatch.chdir(tmp_path)
    _, hint = errors(capsys, "interface", "show", "nav2_msgs/action/Spin")
    assert hint == (
        "'nav2_msgs' is in src/navigation2/nav2_msgs, but it is not built: "
        "colcon build --packages-select nav2_msgs && source install/setup.bash"
    )


@pytest.mark.usefixtures("pose_publisher")
def test_types_to_find(capsys):
    def told(*words):
        assert main([*words]) == 0
        return capsys.readouterr()

    assert told("topic", "find", "turtlesim/msg/Pose") == ("/turtle1/pose\n", "")
    assert told("topic", "find", "Pose").err == (
        "Did you mean: geometry_msgs/msg/Pose, turtlesim/msg/Pose\n"
    )
    assert told("topic", "find", "turtlesim/msg/Color") == ("", "")  # it exists, but no topic
    near = told("service", "find", "std_srvs/srv/Emty")
    assert near.err.startswith("Did you mean: std_srvs/srv/Empty")
    assert near.out == ""


def test_parameters_and_services(run, capsys):
    node = run(sys.executable, "-m", "turtlesim.turtlesim_node", "--headless")
    node.wait_for("Spawning turtle")
    near = "Did you mean: background_r, "
    message, hint = errors(capsys, "param", "get", "/turtlesim", "backgroud_r")
    assert message == "Parameter not set"
    assert hint.startswith(near)
    assert main(["param", "set", "/turtlesim", "backgroud_r", "3"]) == 0
    message, hint = capsys.readouterr().err.splitlines()
    assert (
        message
        == "Setting parameter failed: parameter 'backgroud_r' cannot be set because it was not "
        "declared"
    )
    assert hint.startswith(near)
    assert main(["param", "describe", "/turtlesim", "backgroud_r"]) == 0
    assert capsys.readouterr().err.startswith(near)
    assert errors(capsys, "service", "type", "/spwn") == ["Did you mean: /spawn"]
    assert main(["action", "info", "/turtle1/rotate_absolut"]) == 0
    assert capsys.readouterr().err == "Did you mean: /turtle1/rotate_absolute\n"


LAUNCH = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument

def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("target_frame", default_value="turtle1")])
"""


def test_launch_arguments(ros2_launch):
    launch = ros2_launch(LAUNCH, "targt_frame:=turtle3", "quite_another:=1")
    assert launch.wait() == 0
    warning = launch.text.splitlines()[2:]
    assert warning == [
        "[WARNING] [launch]: the launch file declares no argument 'targt_frame'",
        "Did you mean: target_frame",
    ]
