"""Interfaces by name."""

from pathlib import Path

import pytest

import rosidl_runtime_py
from ament_index_python import get_package_share_directory, get_resource
from geometry_msgs.msg import Twist
from rosidl_runtime_py import utilities
from rosidl_runtime_py.utilities import (
    get_action,
    get_interface,
    get_message,
    get_service,
    is_action,
    is_message,
    is_service,
)
from turtlesim.action import RotateAbsolute
from turtlesim.srv import Spawn


def test_names_lead_to_the_classes_of_the_packages():
    assert get_message("geometry_msgs/msg/Twist") is get_message("geometry_msgs/Twist") is Twist
    assert get_service("turtlesim/srv/Spawn") is get_interface("turtlesim/srv/Spawn") is Spawn
    assert get_action("turtlesim/action/RotateAbsolute") is RotateAbsolute
    assert (is_message(Twist), is_service(Spawn), is_action(RotateAbsolute)) == (True, True, True)
    assert (is_message(Spawn), is_service(RotateAbsolute), is_action(3)) == (False, False, False)


@pytest.mark.parametrize(
    ("name", "error", "text"),
    [
        (
            "geometry_msgs/msg/Nope",
            AttributeError,
            "module 'geometry_msgs.msg' has no attribute 'Nope'",
        ),
        ("nope_msgs/msg/X", ModuleNotFoundError, "No module named 'nope_msgs'"),
        (
            "turtlesim/srv/Spawn",
            ValueError,
            "Expected the full name of a message, got 'turtlesim/srv/Spawn'",
        ),
        (
            "Twist",
            ValueError,
            "Expected the full name of an interface (package/msg/Name), got 'Twist'",
        ),
        (
            "a/b/../c",
            ValueError,
            "Expected the full name of an interface (package/msg/Name), got 'a/b/../c'",
        ),
    ],
)
def test_unknown_names_are_errors(name, error, text):
    with pytest.raises(error) as caught:
        get_message(name)
    assert str(caught.value) == text


def test_interfaces_are_listed_by_package():
    assert rosidl_runtime_py.get_interfaces(["std_srvs"]) == {
        "std_srvs": ["srv/Empty", "srv/SetBool", "srv/Trigger"]
    }
    assert rosidl_runtime_py.get_message_interfaces(["turtlesim"]) == {
        "turtlesim": ["msg/Color", "msg/Pose"]
    }
    assert rosidl_runtime_py.get_action_interfaces()["turtlesim"] == ["action/RotateAbsolute"]
    assert "geometry_msgs" not in rosidl_runtime_py.get_service_interfaces()
    assert "rcl_interfaces" in rosidl_runtime_py.get_interface_packages()
    with pytest.raises(LookupError, match="Unknown package 'nope'"):
        rosidl_runtime_py.get_interfaces(["nope"])


def test_packages_have_their_definitions_in_share():
    """Programs put paths together from the share folder, as with a real ROS 2."""
    share = Path(get_package_share_directory("std_msgs"))
    assert (share / "msg/String.msg").read_text().splitlines()[-1] == "string data"
    assert "struct String {" in (share / "msg/String.idl").read_text()
    for ending in ("msg", "idl"):
        path = rosidl_runtime_py.get_interface_path(f"std_msgs/msg/String.{ending}")
        assert path == str(share / f"msg/String.{ending}")
    listed, _ = get_resource("rosidl_interfaces", "std_msgs")
    assert {"msg/String.msg", "msg/String.idl"} <= {*listed.splitlines()}


def test_paths_lead_to_definitions():
    path = Path(rosidl_runtime_py.get_interface_path("turtlesim/msg/Color"))
    assert path.read_text() == "uint8 r\nuint8 g\nuint8 b\n"
    assert rosidl_runtime_py.get_interface_path("turtlesim/msg/Color.msg") == str(path)


def test_a_path_has_the_ending_that_was_asked_for(tmp_path, monkeypatch):
    folder = tmp_path / "share" / "p_idl" / "msg"
    folder.mkdir(parents=True)
    for ending in ("msg", "idl", "foo"):
        (folder / f"B.{ending}").write_text("bool b\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    path = rosidl_runtime_py.get_interface_path
    assert path("p_idl/msg/B") == str(folder / "B.msg")
    assert path("p_idl/msg/B.msg") == str(folder / "B.msg")
    assert path("p_idl/msg/B.idl") == str(folder / "B.idl")
    with pytest.raises(LookupError, match=r"Could not find the interface '.*B\.foo'"):
        path("p_idl/msg/B.foo")


@pytest.mark.parametrize(
    ("name", "error", "text"),
    [
        ("Twist", ValueError, "Invalid name 'Twist'. Expected at least two parts separated by '/'"),
        ("a//b", ValueError, "Invalid name 'a//b'. Must not contain empty parts"),
        ("a/../b", ValueError, "Invalid name 'a/../b'. Must not contain '..'"),
        ("nope/msg/X", LookupError, "Unknown package 'nope'"),
        ("turtlesim/msg/X", LookupError, "unknown interface 'turtlesim/msg/X'"),
        ("turtlesim/msg/X.idl", LookupError, "unknown interface 'turtlesim/msg/X'"),
        ("turtlesim/msg/Color.foo", LookupError, "Could not find the interface '/"),
        ("turtlesim/msg/Color.msg.bak", LookupError, "Could not find the interface '/"),
        ("turtlesim/msg/Color.", LookupError, "Could not find the interface '/"),
    ],
)
def test_paths_of_nothing_are_errors(name, error, text):
    with pytest.raises(error) as caught:
        rosidl_runtime_py.get_interface_path(name)
    assert str(caught.value).startswith(text)


def test_types_of_names_of_one_kind():
    twist = utilities.get_message_namespaced_type("geometry_msgs/Twist")
    assert twist == utilities.get_namespaced_type("geometry_msgs/msg/Twist")
    assert utilities.get_service_namespaced_type("turtlesim/srv/Spawn").name == "Spawn"
    assert utilities.get_action_namespaced_type("p/Go").namespaces == ("p", "action")
    with pytest.raises(ValueError, match="full name of a message, got 'turtlesim/srv/Spawn'"):
        utilities.get_message_namespaced_type("turtlesim/srv/Spawn")
