"""Completions of the next word for a shell."""

import os
import sys

import pytest
import yaml
from tests.programs import offered

from ros2cli.completion import interface_names, prototype
from rosidl_runtime_py import set_message_fields
from rosidl_runtime_py.utilities import get_message
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def offered_at_last(line):
    """Press TAB again while it offers nothing: under load, it gives up too soon."""
    return next((found for _ in range(20) if (found := offered(line))), set())


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 to", {"topic"}),
        ("ros2 topic e", {"echo"}),
        ("ros2 topic pub --qos-rel", {"--qos-reliability"}),
        ("ros2 interface show geometry_msgs/msg/TwistSt", {"geometry_msgs/msg/TwistStamped"}),
        ("ros2 topic echo --qos-reliability best_e", {"best_effort"}),
    ],
)
def test_words_that_are_known_without_nodes(line, expected):
    assert offered(line) == expected


def test_names_of_the_graph():
    context = open_context()
    try:
        node = context.create_node("some_node")
        node.create_publisher(
            "/some/topic", TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64), QoS()
        )
        assert offered_at_last("ros2 topic echo /some") == {"/some/topic"}
        assert offered_at_last("ros2 topic pub /some/topic ") >= {"std_msgs/msg/String"}
        assert offered_at_last("ros2 node info /so") == {"/some_node"}
    finally:
        context.close()


def test_names_of_parameters(run):
    program = (
        "import rclpy; rclpy.init(); node = rclpy.create_node('some_node'); "
        "node.declare_parameter('speed', 1.0); "
    )
    other = run(sys.executable, "-c", program + "print('ready', flush=True); rclpy.spin(node)")
    other.wait_for("ready")
    for verb in ("get", "set", "delete", "describe"):
        assert offered_at_last(f"ros2 param {verb} /some_node sp") == {"speed"}
    assert offered("ros2 param get /nobody sp") == set()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 topic pub /x geometry_msgs/msg/Vector3 '", "{x: 0.0, y: 0.0, z: 0.0}"),
        (
            "ros2 topic pub /x geometry_msgs/msg/Twist '",
            "{linear: {x: 0.0, y: 0.0, z: 0.0}, angular: {x: 0.0, y: 0.0, z: 0.0}}",
        ),
        ("ros2 service call /x std_srvs/srv/SetBool '", "{data: false}"),
        ("ros2 action send_goal /x turtlesim/action/RotateAbsolute '", "{theta: 0.0}"),
    ],
)
def test_prototypes_of_values(line, expected):
    assert expected in {word.lstrip("'").rstrip("'") for word in offered(line)}


def test_a_prototype_of_any_message_is_its_default_value():
    names = interface_names("msg")
    assert len(names) > 200
    for name in names:
        [text] = prototype("msg", name)
        message = get_message(name)()
        set_message_fields(message, yaml.safe_load(text))
        assert message == get_message(name)(), text


@pytest.mark.parametrize("line", ["ros2 topic pub /x no/such/Type '", "ros2 topic echo /x y z"])
def test_nothing_is_offered_where_nothing_fits(line, tmp_path, monkeypatch):
    (tmp_path / "some_file").touch()
    monkeypatch.chdir(tmp_path)
    assert {word for word in offered(line) if not word.startswith("-")} == set()


@pytest.mark.parametrize("line", ["ros2 param load /x so", "ros2 launch ./so"])
def test_files_are_offered_where_they_fit(line, tmp_path, monkeypatch):
    (tmp_path / "some_file.launch.py").touch()
    monkeypatch.chdir(tmp_path)
    assert {os.path.basename(word) for word in offered(line)} == {"some_file.launch.py"}
