"""Names that people know from other libraries: the AttributeError says what to use here.

Errors of the engine travel between processes with their hints.
"""

from __future__ import annotations

import builtins
import importlib.metadata
import pickle
import re
import sys
import traceback

import pytest
from tests.places import GOLDEN

import turtlewire
from turtlewire import Buffer
from turtlewire.bag import Bag, BagMessage, BagWriter
from turtlewire.call_errors import hint_at
from turtlewire.errors import BagError, LookupException, WireError
from turtlewire.net.connection import Connection
from turtlewire.trajectory import Trajectory
from turtlewire.urdf import Robot

CLASSES = [
    turtlewire.Transform, turtlewire.Buffer, Bag, BagMessage, BagWriter, Connection, Trajectory,
    Robot,
]  # fmt: skip


def hints_of(cls: type) -> dict[str, str]:
    """Return what to use instead of each name that the class lacks."""
    found = (re.fullmatch(r"<no attribute; use (.*)>", repr(each)) for each in vars(cls).values())
    return {name: match[1] for name, match in zip(vars(cls), found, strict=True) if match}


@pytest.mark.parametrize("cls", CLASSES)
def test_each_hint_names_something_that_exists(cls: type) -> None:
    hints = hints_of(cls)
    assert hints
    for name, advice in hints.items():
        with pytest.raises(AttributeError, match=re.escape(f"has no attribute {name!r}; use ")):
            getattr(cls, name)
        named = re.match(r"\w+(?![\w.])", advice)  # other advice begins with a module or a class
        if named and named[0] not in dir(builtins):
            fields = getattr(cls, "__dataclass_fields__", {})
            assert named[0] in {*dir(cls), *fields} - hints.keys()


def test_an_instance_has_no_such_attribute() -> None:
    transform = turtlewire.Transform("map", "robot", (1, 2, 3))
    with pytest.raises(AttributeError) as caught:
        transform.quaternion  # type: ignore[attr-defined]  # noqa: B018
    assert str(caught.value) == (
        "'Transform' object has no attribute 'quaternion'; use rotation: x, y, z, w"
    )
    assert not hasattr(transform, "inv")
    assert "inv" not in dir(transform)
    assert {"inverse", "rotation", "__eq__"} <= set(dir(transform))
    assert "add_transform" not in dir(turtlewire.Buffer())


def test_an_attribute_of_a_subclass_is_its_own() -> None:
    @hint_at({"old older": "new"})
    class Base:
        new = 1

    class Derived(Base):
        old = 2

    assert Derived().old == 2
    with pytest.raises(AttributeError, match="'Derived' object has no attribute 'older'; use new"):
        Derived().older  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match="type object 'Base' has no attribute 'old'; use new"):
        Base.old  # type: ignore[attr-defined]  # noqa: B018
    Base.old = 3  # type: ignore[attr-defined]
    assert "old" in dir(Derived())


# The public names of ``import turtlewire``.


def test_dir_lists_the_public_names() -> None:
    assert dir(turtlewire) == ["Buffer", "Transform", "__version__", "connect", "show"]
    for name in dir(turtlewire):
        assert getattr(turtlewire, name) is not None


def test_version() -> None:
    assert turtlewire.__version__ == importlib.metadata.version("turtlewire")


def test_other_names_are_errors() -> None:
    with pytest.raises(AttributeError, match="'turtlewire' has no attribute 'Bufer'"):
        _ = turtlewire.Bufer  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "error", [LookupException("no frame"), WireError("no network"), BagError("no bag")]
)
def test_a_pickled_error_keeps_the_hint_that_it_was_given(error):
    copy = pickle.loads(pickle.dumps(error.with_hint("Start a broadcaster.")))
    assert (type(copy), str(copy)) == (type(error), str(error))
    assert copy.hint == "Start a broadcaster."


@pytest.mark.parametrize(
    ("text", "hint", "line"),
    [
        ("no network", "", "no network"),
        ("no network", "Plug it in.", "no network. Plug it in."),
        ("no network?", "Plug\nit in.", "no network? Plug it in."),
    ],
)
def test_text_and_hint_in_one_line(text, hint, line):
    assert WireError(text).with_hint(hint).in_one_line() == line


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions have no notes")
def test_a_traceback_shows_the_hint():
    path = GOLDEN / "bag" / "d_mcap"
    for call, hint in (
        (lambda: Buffer.from_bag(path, topics=["/tf", "/tff"]), "Topics of type tf2_msgs"),
        (
            lambda: Trajectory.from_bag(path, "/odm"),
            "Did you mean: /odom. Topics with poses: /goal",
        ),
    ):
        with pytest.raises(BagError) as caught:
            call()
        assert hint in caught.value.hint
        assert hint not in str(caught.value)
        assert f"\n{hint}" in "".join(traceback.format_exception(caught.value))


def test_a_pickled_error_keeps_the_hint_that_only_the_buffer_could_give():
    buffer = Buffer()
    buffer.set_transform("world", "robot", 1, (0, 0, 0), (0, 0, 0, 1))
    with pytest.raises(LookupException) as caught:
        buffer.lookup_transform("world", "robto")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert "robot" in caught.value.hint
    assert copy.hint == caught.value.hint
