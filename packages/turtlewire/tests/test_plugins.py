"""Entry points of installed packages, as commands find them."""

import sys

import pytest
from tests.programs import run_python

from turtlewire.plugins import Entry, declared


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Return a function that declares entry points of a distribution."""
    monkeypatch.setattr(sys, "path", [str(tmp_path / "missing"), str(tmp_path)])

    def write(distribution, text):
        folder = tmp_path / f"{distribution}-1.0.dist-info"
        folder.mkdir()
        (folder / "entry_points.txt").write_text(text)

    return write


def test_names_and_values_of_one_section(install):
    install(
        "a",
        "[x]\nwrong = a:b\n\n[x.verb]\n# no = entry:point\nsay=os.path:join [extra]\n"
        "two = os : path.join\n[z]\nwrong = a:b\n",
    )
    found = declared("x.verb")
    assert {name: entry.value for name, entry in found.items()} == {
        "say": "os.path:join [extra]",
        "two": "os : path.join",
    }
    assert found["say"].load() is found["two"].load()
    assert (found["say"].module, found["say"].attribute) == ("os.path", "join")
    assert declared("verb") == {}


def test_a_module_is_an_object_too():
    assert Entry("xml", "os.path", is_own=False).load().join


def test_no_package_replaces_what_turtlewire_declares(install):
    install("aaa", "[g]\nx = theirs:X\ny = theirs:Y\n")
    install("turtlewire_ros", "[g]\nx = ours:X\n")
    install("turtlewire_view", "[g]\nz = ours:Z\n")
    found = declared("g")
    assert {name: (entry.module, entry.is_own) for name, entry in found.items()} == {
        "x": ("ours", True),
        "y": ("theirs", False),
        "z": ("ours", True),
    }


@pytest.mark.parametrize(("wanted", "names"), [("x", {"x"}), ("y", {"x", "y"}), ("no", {"x", "y"})])
def test_other_packages_are_read_for_names_that_turtlewire_lacks(install, wanted, names):
    install("aaa", "[g]\ny = theirs:Y\n")
    install("turtlewire", "[g]\nx = ours:X\n")
    assert set(declared("g", wanted)) == names


def test_the_metadata_of_packages_is_not_loaded():
    code = (
        "import sys; from turtlewire.plugins import declared; "
        "assert declared('console_scripts'); print('importlib.metadata' in sys.modules)"
    )
    done = run_python(code)
    assert done.stdout == "False\n"
