"""Each distribution has its interfaces, with the hashes of its own generator.

Finding definitions.

Those that come with us, those of prefixes, those of generated packages, and none.

The cost of imports in modules: heavy modules are imported only when they are needed.
"""

import json
import subprocess
import sys

import pytest
from tests.programs import lines_in, run_python

from tests import places
from turtlewire import msg
from turtlewire.distro import Distro, current_distro, since
from turtlewire.errors import InterfaceError
from turtlewire.msg.registry import (
    interface_path,
    interface_text,
    interfaces,
    load_message,
)

HASHES = json.loads((places.GOLDEN / "distros" / "hashes.json").read_text())

LIST = """
import json
from turtlewire import msg
names = [
    f"{package}/{kind}/{name}"
    for package, kinds in msg.interfaces().items()
    for kind, of_kind in kinds.items()
    for name in of_kind
]
print(json.dumps({name: msg.type_hash(name) for name in names}))
"""


@pytest.mark.parametrize(("distro", "count"), [("jazzy", 386), ("kilted", 396), ("lyrical", 398)])
def test_names_and_hashes_are_those_of_the_distribution(distro, count):
    here = json.loads("".join(lines_in(distro, LIST)))
    real = HASHES["every"] | HASHES[distro]
    # Turtlewire has one more for the demos; the real ones keep it in their own package.
    here.pop("action_tutorials_interfaces/action/Fibonacci")
    assert len(real) == count
    assert here == real


def test_interfaces_of_other_distributions_can_be_loaded():
    old_types = (
        "from turtlewire import msg;"
        "print(msg.type_hash('turtlesim/msg/Pose'), msg.type_hash('geometry_msgs/msg/Pose2D'))"
    )
    assert lines_in("lyrical", old_types) == lines_in("jazzy", old_types)


def test_a_changed_definition_gives_another_class():
    fields = """
from lifecycle_msgs.msg import TransitionEvent
print(*TransitionEvent.get_fields_and_field_types())
"""
    assert lines_in("kilted", fields)[0].split()[0] == "timestamp"
    assert lines_in("lyrical", fields)[0].split()[0] == "stamp"


CONSTRUCT = """
from geometry_msgs.msg import Vector3
from std_msgs.msg import Empty

def outcome(make):
    try:
        return make()
    except Exception as error:
        return f"{type(error).__name__}: {error}"

print(outcome(lambda: Vector3(x=None).x))
print(outcome(lambda: Vector3(q=1.0)))
print(outcome(lambda: Empty(q=1.0)))
print(outcome(lambda: Vector3(x="1", check_fields=True)))
print(outcome(lambda: Vector3(x="1", check_fields=False).x))
"""


@pytest.mark.parametrize("checks", ["0", "1"])
def test_constructors_of_lyrical_refuse_unknown_keywords_and_take_none(monkeypatch, checks):
    monkeypatch.setenv("ROS_PYTHON_CHECK_FIELDS", checks)
    assert lines_in("lyrical", CONSTRUCT) == [
        "0.0",
        "TypeError: Vector3.__init__() got an unexpected keyword argument 'q'",
        "TypeError: Empty.__init__() got an unexpected keyword argument 'q'",
        "AssertionError: The 'x' field must be of type 'float'",
        "1",
    ]
    monkeypatch.setenv("ROS_PYTHON_CHECK_FIELDS", "0")
    assert lines_in("kilted", CONSTRUCT)[:2] == [
        "None",
        "AssertionError: Invalid arguments passed to constructor: q",
    ]


@pytest.mark.parametrize(
    ("name", "distro"),
    [
        (None, "jazzy"),
        ("", "jazzy"),
        ("humble", "jazzy"),
        ("jazzy", "jazzy"),
        ("kilted", "kilted"),
        ("lyrical", "lyrical"),
        ("rolling", "lyrical"),
        ("a typo", "jazzy"),
    ],
)
def test_the_variable_chooses_the_distribution(monkeypatch, name, distro):
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    if name is not None:
        monkeypatch.setenv("ROS_DISTRO", name)
    assert str(current_distro()) == distro
    assert [since(each) for each in Distro] == [each <= current_distro() for each in Distro]


LISTS = """
import warnings
from sensor_msgs.msg import JointState
from turtlewire.msg import deserialize, serialize

warnings.simplefilter("always")
names = ["a"]
state = JointState(name=names)
print(state.name is names)
state.name = ("b", "c")
print(state.name)
state._name = iter("de")
print(state.name)
print(deserialize(JointState, serialize(state)).name)
for field, value in (("name", {"f"}), ("position", {1.0})):
    with warnings.catch_warnings(record=True) as warned:
        setattr(state, field, value)
    print(getattr(state, field), *(f"{w.category.__name__}: {w.message}" for w in warned))
try:
    state.name = 3
    print(state.name)
except TypeError as error:
    print(error)
try:
    JointState(name=[1], check_fields=True)
except AssertionError as error:
    print(error)
"""
_SET = (
    "DeprecationWarning: Using set or subclass of set is deprecated, please use a subclass of "
    "collections.abc.Sequence like list"
)


def test_fields_of_lyrical_hold_lists():
    assert lines_in("lyrical", LISTS) == [
        "True",
        "['b', 'c']",
        "['d', 'e']",
        "['d', 'e']",
        f"['f'] {_SET}",
        f"array('d', [1.0]) {_SET}",
        "sensor_msgs/msg/JointState: field 'name' holds a list: 'int' object is not iterable",
        "The 'name' field must be a sequence and each value of type 'str'",
    ]
    kilted = lines_in("kilted", LISTS.replace('iter("de")', '("d", "e")'))
    assert kilted == [
        *("True", "('b', 'c')", "('d', 'e')", "['d', 'e']", "{'f'}", "array('d', [1.0])", "3"),
        "The 'name' field must be a set or sequence and each value of type 'str'",
    ]


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


HEAVY = {
    "numpy",
    "dataclasses",
    "inspect",
    "asyncio",
    "json",
    "yaml",
    "concurrent",
    "subprocess",
    "uuid",
    "http",
    "logging",
    "argparse",
}


@pytest.mark.parametrize(
    "program",
    [
        "from turtlewire import msg",
        (
            "from turtlewire import msg; cls = msg.get_message('tf2_msgs/msg/TFMessage'); "
            "msg.deserialize(cls, msg.serialize(cls()))"
        ),
        "from geometry_msgs.msg import TransformStamped; TransformStamped()",
        (
            "from turtlewire import msg; cls = msg.get_message('sensor_msgs/msg/Imu'); "
            "msg.serialize(msg.deserialize(cls, msg.serialize(cls())))"
        ),
        "from turtlewire import msg; msg.type_hash('rcl_interfaces/srv/SetParameters_Request')",
        "import rosidl_runtime_py.utilities",
    ],
)
def test_nothing_heavy_is_imported(program):
    code = (
        program + "\nimport sys\nloaded = {name.partition('.')[0] for name in sys.modules}\nimport "
        "json\nprint(json.dumps(sorted(loaded)))"
    )
    done = subprocess.run(
        [sys.executable, "-I", "-c", code], capture_output=True, text=True, check=True
    )
    assert HEAVY & set(json.loads(done.stdout)) == set()


def test_a_codec_is_generated_at_first_use_only():
    program = """
from turtlewire import msg
cls = msg.get_message("geometry_msgs/msg/Twist")
made = lambda: [m.__code__.co_filename.startswith("<") for m in (cls._to_cdr, cls._from_cdr)]
steps = [made()]
data = msg.serialize(cls())
steps.append(made())
msg.deserialize(cls, data)
print([*steps, made()])
"""
    done = run_python(program)
    assert done.stdout == "[[False, False], [True, False], [True, True]]\n"
