"""`turtlewire view NAME`: robots of a package robot_descriptions that the tests make."""

from __future__ import annotations

import os
import signal
import sys

import pytest
from tests.places import TURTLEWIRE
from websockets.sync.client import connect

import turtlewire
from turtlewire_view.named_robots import find_robot

from .packets import decode_packet

URDF = """<robot name="crane">
  <link name="mast"><visual><geometry><mesh filename="package://{package}/mast.stl"/></geometry>
  </visual></link><link name="boom"/>
  <joint name="lift" type="revolute"><parent link="mast"/><child link="boom"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"""
INDEX = """
from types import SimpleNamespace
DESCRIPTIONS = {
    name: SimpleNamespace(has_urdf="_mj_" not in name, has_mjcf="_mj_" in name)
    for name in ("crane_description", "crate_description", "lost_description", "bare_description",
                 "spun_description", "crane_mj_description")
}
"""
MODULE = """
REPOSITORY_PATH = {root!r} + "/cache/cranes"
PACKAGE_PATH = REPOSITORY_PATH + "/crane_description"
{more}
"""
LOST = """
raise RuntimeError(
    "Cmd('git') failed due to: exit code(128)\\n"
    "  stderr: 'fatal: unable to access: Could not resolve host: example.org'"
)
"""
#: What the view uses of xacrodoc.
XACRODOC = """
from pathlib import Path
class XacroDoc:
    @classmethod
    def from_file(cls, path, subargs):
        doc = cls()
        doc.text = Path(path).read_text().replace("$(arg hand)", subargs["hand"])
        return doc
    def to_urdf_string(self):
        return self.text
"""


@pytest.fixture
def path(tmp_path, monkeypatch):
    """A folder on Python's path with a package ``robot_descriptions``; nothing is fetched."""
    robots = tmp_path / "lib/robot_descriptions"
    package = tmp_path / "cache/cranes/crane_description"
    for folder in (robots, package):
        folder.mkdir(parents=True)
    (package / "mast.stl").touch()
    (package / "crane.urdf").write_text(URDF.format(package="crane_description"))
    (package / "crane.urdf.xacro").write_text(
        URDF.format(package="crane_description").replace('"boom"', '"$(arg hand)"')
    )
    (robots / "__init__.py").write_text(INDEX)
    for name, more in (
        ("crane", "URDF_PATH = PACKAGE_PATH + '/crane.urdf'"),
        ("bare", "URDF_PATH = PACKAGE_PATH + '/none.urdf'"),
        ("spun", "XACRO_PATH = PACKAGE_PATH + '/crane.urdf.xacro'\nXACRO_ARGS = {'hand': 'claw'}"),
    ):
        text = MODULE.format(root=str(tmp_path), more=more)
        (robots / f"{name}_description.py").write_text(text)
    (robots / "lost_description.py").write_text(LOST)
    monkeypatch.setattr(sys, "path", [str(tmp_path / "lib"), *sys.path])
    monkeypatch.chdir(tmp_path)
    yield tmp_path / "lib"
    for name in list(sys.modules):
        if name.split(".")[0] in {"robot_descriptions", "xacrodoc"}:
            del sys.modules[name]


@pytest.mark.parametrize("name", ["crane", "crane_description"])
def test_a_robot_of_a_name(path, name):
    robot, packages = find_robot(name, {})
    assert robot.name == "crane"
    folder = path.parent / "cache/cranes/crane_description"
    assert packages.folder("crane_description") == str(folder)
    assert packages.folder("cranes") == str(folder.parent)


def test_a_file_or_folder_of_the_name_is_meant(path):
    (path.parent / "crane").mkdir()
    assert find_robot("crane", {}) is None
    assert find_robot(str(path), {}) is None


def test_a_robot_that_xacro_makes(path, monkeypatch):
    monkeypatch.setitem(sys.modules, "xacrodoc", None)  # as if it were not installed
    with pytest.raises(ModuleNotFoundError, match=r"spun needs xacrodoc: pip install 'turtlewire"):
        find_robot("spun", {})
    monkeypatch.delitem(sys.modules, "xacrodoc")
    (path / "xacrodoc").mkdir()
    (path / "xacrodoc/__init__.py").write_text(XACRODOC)
    (path / "xacrodoc/packages.py").write_text("def update_package_cache(folders): pass")
    robot, packages = find_robot("spun", {})
    assert set(robot.links) == {"mast", "claw"}
    assert packages.folder("crane_description") is not None


@pytest.mark.parametrize(
    ("name", "kind", "why"),
    [
        ("cran", FileNotFoundError, "no robot of this name. Did you mean: crane"),
        ("zzz", FileNotFoundError, "robot_descriptions has no robot of this name"),
        ("crane_mj", ValueError, "only as MJCF, and the view shows URDF. Did you mean: crane"),
        ("lost", ConnectionError, "of lost cannot be fetched: fatal: unable to access: "),
        ("lost", ConnectionError, "resolve host: example.org. git fetches it when it is shown"),
        ("bare", FileNotFoundError, "none.urdf"),
    ],
)
@pytest.mark.usefixtures("path")
def test_robots_that_are_not_shown(name, kind, why):
    with pytest.raises(kind) as raised:
        find_robot(name, {})
    assert why in str(raised.value)


def test_without_the_package_the_error_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "robot_descriptions", None)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "crane_bag").mkdir()
    with pytest.raises(FileNotFoundError) as raised:
        find_robot("crane_bog", {})
    assert "did you mean 'crane_bag'?; to show a robot of this name" in str(raised.value)
    assert "pip install 'turtlewire-view[robots]'" in str(raised.value)


def test_a_program_shows_a_robot_of_a_name(path, monkeypatch, open_view_page):
    assert path.is_dir()
    monkeypatch.setenv("TURTLEWIRE_BROWSER", "0")
    with turtlewire.show("crane", positions={"lift": 0.5}, port=0) as view:
        page = open_view_page(view)
        assert page.wait_for("hello")["source"]["name"] == "crane"
        page.wait_for("positions", lambda packet: packet["of"] == [0.5])


def test_the_command_shows_a_robot_with_its_meshes(path, run):
    environment = {"PYTHONPATH": os.pathsep.join([str(path), os.environ.get("PYTHONPATH", "")])}
    program = run(TURTLEWIRE, "view", "crane", "--port", "0", environment=environment)
    address = program.wait_for(r"The view is at http(://127\.0\.0\.1:\d+/)")[0][1]
    with connect(f"ws{address}live", max_size=None) as page:
        packets = map(decode_packet, page)
        joints = next(each for each in packets if each["type"] == "joints")["joints"]
        assert [joint["name"] for joint in joints] == ["lift"]
    program.process.send_signal(signal.SIGTERM)
    assert program.wait() == 0
    for name, why in (
        ("cran", "turtlewire view: cran: No such file or directory, and robot_descriptions has"),
        ("lost", "turtlewire view: the description of lost cannot be fetched: "),
    ):
        program = run(TURTLEWIRE, "view", name, "--port", "0", environment=environment)
        assert program.wait() == 2
        assert why in program.text
        assert "Traceback" not in program.text
