"""Each distribution has its interfaces, with the hashes of its own generator."""

from __future__ import annotations

import json

import pytest
from tests.distros import lines_in

from tests import places
from turtlewire.distro import Distro, current_distro, since

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
