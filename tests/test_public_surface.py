"""`tools/public_surface.py`: what the next release would break, in small checkouts."""

import subprocess

import pytest

pytest.importorskip("griffe", reason="scripts/setup lint installs it")
import public_surface

BEFORE = {
    "__init__.py": "from turtlewire.store import Store, look\n__all__ = ['Store', 'look']\n",
    "store.py": (
        "class Base:\n    def close(self): ...\n"
        "class Store(Base):\n    def get(self, name, default=None): ...\n    def _find(self): ...\n"
        "def look(target, source): ...\ndef inside(): ...\n"
    ),
}


def git(folder, *arguments):
    settings = ("-c", "user.name=x", "-c", "user.email=x@example.org", "-c", "commit.gpgsign=false")
    subprocess.run(["git", *settings, *arguments], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def checkout(tmp_path):
    """A released package; the folder of its modules."""
    folder = tmp_path / "packages" / "turtlewire" / "src" / "turtlewire"
    folder.mkdir(parents=True)
    for name, text in BEFORE.items():
        (folder / name).write_text(text)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-qm", "x")
    git(tmp_path, "tag", "v1.2.0")
    return folder


def found(checkout, **changed):
    for name, (old, new) in changed.items():
        path = checkout / f"{name}.py"
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))
    return list(public_surface.breakages(checkout.parents[3], "turtlewire", [""], "v1.2.0"))


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("def get(", "def take(", "Store.get: Public object was removed"),
        (", default=None", "", "Store.get: Parameter was removed"),
        ("default=None", "default=1", "Store.get: Parameter default was changed"),
        ("target, source", "target, source, time", "look: Parameter was added as required"),
        ("(target, source", "(target, *, source", "look: Parameter kind was changed"),
        ("def close(", "def shut(", "Store.close: Public object was removed"),
    ],
)
def test_a_program_that_would_fail_is_found(checkout, old, new, line):
    (only,) = found(checkout, store=(old, new))
    assert line in only


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("def _find(", "def _search("),
        ("def inside(", "def other("),
        ("target, source", "target, source, time=None"),
        ("class Store", "class More: ...\nclass Store"),
    ],
)
def test_additions_and_private_names_are_free(checkout, old, new):
    assert found(checkout, store=(old, new)) == []


def test_a_name_may_move_but_must_stay_exported(checkout):
    (checkout / "store.py").rename(checkout / "stores.py")
    init = checkout / "__init__.py"
    init.write_text(init.read_text().replace("turtlewire.store", "turtlewire.stores"))
    assert found(checkout) == []
    init.write_text("from turtlewire.stores import Store\n__all__ = ['Store']\n")
    (only,) = found(checkout)
    assert "look: Public object was removed" in only


def test_the_last_release_is_the_newest_tag_of_a_version(checkout):
    root = checkout.parents[3]
    git(root, "tag", "nightly")
    assert public_surface.last_release(root) == "v1.2.0"
    git(root, "tag", "-d", "v1.2.0")
    assert public_surface.last_release(root) == ""


@pytest.mark.parametrize(
    ("before", "now", "may"),
    [
        ("v1.2.0", "1.9.0", False),
        ("v1.2.0", "2.0.0", True),
        ("v0.1.0", "0.1.5", False),
        ("v0.1.0", "0.2.0", True),
        ("v0.9.0", "1.0.0", True),
    ],
)
def test_only_some_versions_may_break_a_promise(before, now, may):
    assert public_surface.may_break(before, now) is may
