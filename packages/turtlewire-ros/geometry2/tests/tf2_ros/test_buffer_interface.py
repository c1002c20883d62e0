"""Registrations, conversions and transform()."""

import subprocess
import sys

import pytest

from geometry_msgs.msg import PointStamped, Pose, Vector3Stamped
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_ros import (
    Buffer,
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from tf2_ros.buffer_interface import NO_TIMEOUT


class Note:
    """A type with a header that no other test registers."""

    def __init__(self, x=0.0):
        self.x = x


class Memo(Note):
    """Another type with a header that no other test registers."""


@pytest.fixture
def buffer(stamped):
    buffer = Buffer()
    for second in (1, 2):
        buffer.set_transform(stamped("world", "robot", x=float(second), stamp_s=second), "me")
    return buffer


@pytest.fixture
def _registered(monkeypatch):
    for table in ("_to_msg", "_from_msg", "_convert"):
        monkeypatch.setattr(ConvertRegistration, table, {})
    monkeypatch.setattr(TransformRegistration, "_transforms", {})
    TransformRegistration().add(
        Note, lambda note, transform: Note(note.x + transform.transform.translation.x)
    )


@pytest.mark.usefixtures("_registered")
def test_transform_applies_the_registered_function_at_the_stamp(buffer):
    note = Stamped(Note(10.0), Time(seconds=2).to_msg(), "robot")
    assert buffer.transform(note, "world").x == 12.0
    assert buffer.transform(note, "world", timeout=Duration(seconds=1)).x == 12.0
    assert buffer.transform_full(note, "robot", Time(seconds=1), "world").x == 11.0


@pytest.mark.usefixtures("_registered")
def test_transform_converts_when_asked(buffer):
    ConvertRegistration().add_convert((Note, Memo), lambda note: Memo(note.x))
    note = Stamped(Note(10.0), Time(seconds=2).to_msg(), "robot")
    assert type(buffer.transform(note, "world", new_type=Memo)) is Memo
    assert (
        type(buffer.transform_full(note, "robot", Time(seconds=1), "world", new_type=Memo)) is Memo
    )


@pytest.mark.usefixtures("_registered")
def test_unknown_types_are_named(buffer, capsys):
    with pytest.raises(TypeException) as error:
        buffer.transform(PointStamped(), "world")
    assert (
        error.value.errstr == str(error.value) == f"Type {PointStamped} is not loaded or supported"
    )
    assert "import tf2_geometry_msgs" in "".join(
        getattr(error.value, "__notes__", ["import tf2_geometry_msgs"])
    )
    TransformRegistration().print_me()
    assert "Note" in capsys.readouterr().out


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions have notes since Python 3.11")
@pytest.mark.parametrize("package", ["geometry_msgs", "nav_msgs", "sensor_msgs"])
def test_the_import_is_named_where_it_helps_and_nowhere_else(package):
    code = f"""
import {package}.msg as messages
from tf2_ros import TransformRegistration, TypeException

def advice(kind):
    try:
        TransformRegistration().get(kind)
    except TypeException as error:
        return "".join(getattr(error, "__notes__", []))

kinds = [getattr(messages, name) for name in messages.__all__]
said = {{kind: text for kind in kinds if "registers" in (text := advice(kind))}}
assert "tf2_geometry_msgs" not in __import__("sys").modules
import tf2_geometry_msgs, tf2_sensor_msgs
known = TransformRegistration()._transforms
assert {{*said}} == {{kind for kind in kinds if kind in known}}
for kind, text in said.items():
    module = known[kind].__module__.partition(".")[0]
    assert text == f"`import {{module}}` registers this type.", text
print(len(said), "of", len(kinds))
"""
    found = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stderr
    assert not found.stdout.startswith("0 ")
    assert "of 0" not in found.stdout


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions take notes since Python 3.11")
def test_a_type_without_a_frame_names_the_one_to_take():
    with pytest.raises(TypeException) as error:
        TransformRegistration().get(Pose)
    assert str(error.value) == f"Type {Pose} is not loaded or supported"
    assert error.value.__notes__ == ["A Pose does not name its frame: transform a PoseStamped."]


@pytest.mark.usefixtures("_registered")
def test_convert_takes_the_direct_way_then_a_copy_then_the_message():
    note = Note(3.0)
    same = convert(note, Note)
    assert same is not note
    assert same.x == 3.0
    with pytest.raises(TypeException):
        convert(note, Memo)
    registration = ConvertRegistration()
    registration.add_to_msg(Note, lambda note: ("message", note.x))
    registration.add_from_msg(Memo, lambda message: Memo(message[1] + 1))
    assert convert(note, Memo).x == 4.0
    registration.add_convert((Note, Memo), lambda note: Memo(note.x + 2))
    assert convert(note, Memo).x == 5.0
    assert registration.get_to_msg(Note) is not None
    with pytest.raises(TypeException):
        registration.get_from_msg(Note)


def test_stamped_sets_the_header_in_place():
    vector = Vector3Stamped()
    assert Stamped(vector, Time(seconds=4).to_msg(), "robot") is vector
    assert (vector.header.stamp.sec, vector.header.frame_id) == (4, "robot")


def test_the_interface_itself_answers_nothing():
    interface = BufferInterface()
    calls = [
        lambda: interface.lookup_transform("a", "b", Time()),
        lambda: interface.lookup_transform_full("a", Time(), "b", Time(), "c"),
        lambda: interface.can_transform("a", "b", Time()),
        lambda: interface.can_transform_full("a", Time(), "b", Time(), "c", NO_TIMEOUT),
    ]
    for call in calls:
        with pytest.raises(NotImplementedException) as error:
            call()
        assert error.value.errstr == "CanTransform or LookupTransform not implemented"
