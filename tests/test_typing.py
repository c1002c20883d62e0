"""User code under mypy --strict: correct code passes, each wrong line is rejected."""

import ast
import importlib
import re
import subprocess
import sys
from pathlib import Path

import distributions
import pytest

FOLDER = Path(__file__).parent / "typed"
PACKAGES = ("bag", "errors", "geometry", "msg", "net", "testing", "trajectory", "urdf", "viewing")
#: Classes of which every public attribute is used.
CLASSES = (
    "turtlewire.Buffer",
    "turtlewire.Transform",
    "turtlewire.bag.BagMessage",
    "turtlewire.net.Connection",
    "turtlewire.net.Publisher",
    "turtlewire.net.Subscription",
    "turtlewire.trajectory.Comparison",
    "turtlewire.trajectory.Trajectory",
    "turtlewire.urdf.Robot",
    "turtlewire.viewing.Viewer",
)


@pytest.fixture(scope="module")
def refused(tmp_path_factory):
    """The lines of both files that mypy refuses, and what it says about them."""
    pytest.importorskip("mypy", reason="needs mypy (scripts/setup lint)")
    mypy = [sys.executable, "-m", "mypy", "--strict", "--no-incremental", "--config-file="]
    said = subprocess.run(
        [*mypy, "user_code.py", "wrong_uses.py"],
        cwd=FOLDER,
        capture_output=True,
        text=True,
        check=False,
    )
    assert said.returncode == 1, said.stdout + said.stderr
    found = {"user_code.py": {}, "wrong_uses.py": {}}
    for file, line, text in re.findall(r"^(\w+\.py):(\d+): error: (.*)", said.stdout, re.MULTILINE):
        found[file].setdefault(int(line), []).append(text)
    return found


def test_user_code_is_accepted(refused):
    assert refused["user_code.py"] == {}


def test_each_wrong_line_is_refused(refused):
    lines = (FOLDER / "wrong_uses.py").read_text(encoding="utf-8").splitlines()
    wrong = {number for number, line in enumerate(lines, 1) if line.endswith("# no")}
    assert len(wrong) > 70
    assert refused["wrong_uses.py"].keys() == wrong, refused["wrong_uses.py"]


def test_each_package_says_that_it_has_types():
    """The build adds the file to the packages of ROS 2."""
    folders = [
        folder for folder in distributions.packages() if distributions.ROS not in folder.parents
    ]
    assert len(folders) > 5
    assert [folder for folder in folders if not (folder / "py.typed").exists()] == []


def used():
    """The names that the user code imports, and the attributes that it uses."""
    tree = ast.parse((FOLDER / "user_code.py").read_text(encoding="utf-8"))
    imported, attributes = set(), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            imported |= {f"{node.module}.{each.name}" for each in node.names}
        elif isinstance(node, ast.Attribute):
            attributes.add(node.attr)
            imported.add(ast.unparse(node))
    return imported, attributes


@pytest.mark.parametrize("package", ["", *PACKAGES])
def test_user_code_uses_every_public_name(package):
    module = importlib.import_module(f"turtlewire.{package}".rstrip("."))
    names, _ = used()
    unused = [
        name
        for name in module.__all__
        if not {f"{module.__name__}.{name}", f"{package}.{name}"} & names
    ]
    assert unused == []


@pytest.mark.parametrize("name", CLASSES)
def test_user_code_uses_every_attribute(name):
    module, _, attribute = name.rpartition(".")
    cls = getattr(importlib.import_module(module), attribute)
    # Names with advice in place of an attribute are listed, but do not exist.
    public = {each for each in dir(cls) if not each.startswith("_") and hasattr(cls, each)}
    if hasattr(cls, "_fields"):
        public -= {"count", "index"}  # of tuple
    assert public - used()[1] == set()
