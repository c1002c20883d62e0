"""Finding definitions.

Those that come with us, those of prefixes, those of generated packages, and none.
"""

from __future__ import annotations

import sys

import pytest

from turtlewire import msg
from turtlewire.errors import InterfaceError
from turtlewire.msg.registry import (
    interface_path,
    interface_text,
    interfaces,
    load_action,
    load_message,
    load_service,
)


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    folder = tmp_path / "share" / "prefix_interfaces" / "msg"
    folder.mkdir(parents=True)
    (folder / "Thing.msg").write_text("geometry_msgs/Point place\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    return tmp_path


def test_definitions_of_a_prefix_are_found(prefix):
    assert interfaces()["prefix_interfaces"] == {"msg": ["Thing"], "srv": [], "action": []}
    assert interface_path("prefix_interfaces/msg/Thing") == str(
        prefix / "share/prefix_interfaces/msg/Thing.msg"
    )
    assert repr(msg.get_message("prefix_interfaces/msg/Thing")()) == (
        "prefix_interfaces.msg.Thing(place=geometry_msgs.msg.Point(x=0.0, y=0.0, z=0.0))"
    )


def test_packages_that_pip_installed_need_no_sourcing(prefix, monkeypatch):
    """An environment's index names them; what else lies in ``share`` is not looked at."""
    monkeypatch.setenv("AMENT_PREFIX_PATH", "")
    monkeypatch.setattr(sys, "prefix", str(prefix))
    assert "prefix_interfaces" not in interfaces()
    index = prefix / "share/ament_index/resource_index/rosidl_interfaces"
    index.mkdir(parents=True)
    (index / "prefix_interfaces").write_text("msg/Thing.msg\nmsg/Thing.idl")
    assert interfaces()["prefix_interfaces"]["msg"] == ["Thing"]
    path = prefix / "share/prefix_interfaces/msg/Thing.msg"
    assert interface_path("prefix_interfaces/msg/Thing") == str(path)


def test_our_definitions_win_over_those_of_a_prefix(tmp_path, monkeypatch):
    folder = tmp_path / "share" / "std_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "String.msg").write_text("int32 other\n")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert "other" not in interface_text("std_msgs/msg/String")
    assert len(interfaces()["std_msgs"]["msg"]) == 30


def test_all_interfaces_are_listed():
    names = interfaces()
    assert len(names) == 32
    assert names["turtlesim"] == {
        "msg": ["Color", "Pose"],
        "srv": ["Kill", "SetPen", "Spawn", "TeleportAbsolute", "TeleportRelative"],
        "action": ["RotateAbsolute"],
    }
    assert sum(len(kind) for kinds in names.values() for kind in kinds.values()) == 387


@pytest.mark.parametrize(
    ("name", "text", "hint"),
    [
        (
            "geometry_msgs/msg/Twst",
            "unknown interface 'geometry_msgs/msg/Twst'",
            "Did you mean geometry_msgs/msg/Twist",
        ),
        (
            "nope/msg/X",
            "unknown interface 'nope/msg/X'",
            "`ros2 interface list` shows all interfaces.",
        ),
        ("a" * 300 + "/msg/X", f"unknown interface '{'a' * 300}/msg/X'", ""),
        (
            "Twist",
            "'Twist' is not the name of an interface",
            "Did you mean geometry_msgs/msg/Twist?",
        ),
        ("Twst", "'Twst' is not the name of an interface", "Names look like geometry_msgs/msg/T"),
        ("a/msg/../../etc", "'a/msg/..' is not the name of an interface", "Names look like"),
        (
            "geometry_msgs/msgs/Twist",
            "'geometry_msgs/msgs/Twist' is not the name of an interface",
            "Names look like",
        ),
        ("turtlesim/srv/Spawn_Nope", "unknown interface 'turtlesim/srv/Spawn_Nope'", ""),
    ],
)
def test_unknown_names_are_errors_that_help(name, text, hint):
    with pytest.raises(InterfaceError) as caught:
        load_message(name)
    assert str(caught.value).partition("\n")[0] == text
    assert caught.value.hint.startswith(hint)


def test_kinds_are_not_mixed_up():
    with pytest.raises(InterfaceError, match="'turtlesim/srv/Spawn' is not a message"):
        load_message("turtlesim/srv/Spawn")
    with pytest.raises(InterfaceError, match="'turtlesim/msg/Pose' is not a service"):
        load_service("turtlesim/msg/Pose")
    with pytest.raises(InterfaceError, match="'turtlesim/msg/Pose' is not an action"):
        load_action("turtlesim/msg/Pose")
