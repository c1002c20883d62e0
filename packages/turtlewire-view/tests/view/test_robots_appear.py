"""A robot is shown as soon as a node describes it; "Add" is for more.

`turtlewire view NAME`: robots of a package robot_descriptions that the tests make.
"""

from __future__ import annotations

import os
import signal
import sys

import pytest
from tests.places import TURTLEWIRE
from websockets.sync.client import connect

import turtlewire
from turtlewire import msg
from turtlewire.wire.qos import Durability, QoS
from turtlewire_view.robots import find_robot

from .fake_view import decode_packet
from .test_robot_model import URDF

DESCRIPTION = {"name": "/robot_description", "type_name": "std_msgs/msg/String", "publishers": 1}
ROBOT = {**DESCRIPTION, "kind": "robot_model"}
SCAN = {"name": "/scan", "type_name": "sensor_msgs/msg/LaserScan", "publishers": 1}
SCAN["kind"] = "laser_scan"


def shown(page) -> list[str]:
    return page.locator("#display-list .title b").all_inner_texts()


def wait_for_topics(page, count) -> None:
    """Until the page knows that many topics that can be drawn."""
    page.wait_for_function(
        "(count) => document.querySelectorAll('#topic option').length === count + 1", arg=count
    )


def added(fake, **fields) -> list[dict]:
    return [
        command
        for command in fake.commands
        if command["type"] == "add" and fields.items() <= command.items()
    ]


def test_a_described_robot_is_shown_without_a_request(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [SCAN]})
    wait_for_topics(page, 1)
    assert shown(page) == []
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/robot_description")
    assert shown(page) == ["/robot_description"]


def test_each_robot_is_shown_once_and_one_that_was_removed_stays_away(fake, open_view):
    page = open_view(fake.url)
    other = {**ROBOT, "name": "/second/robot_description"}
    fake.tell({"type": "topics", "topics": [ROBOT]})
    # The page sends a display when its module is loaded; one that is removed before is never sent.
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == ROBOT["name"])
    page.click("[aria-label='Remove /robot_description']")
    fake.tell({"type": "topics", "topics": [ROBOT, other]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == other["name"])
    fake.tell({"type": "topics", "topics": [ROBOT, other, SCAN]})
    wait_for_topics(page, 3)
    assert shown(page) == [other["name"]]
    assert len(added(fake, topic="/robot_description")) == 1
    assert len(added(fake, topic=other["name"])) == 1


def test_a_topic_without_a_publisher_describes_no_robot(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [{**ROBOT, "publishers": 0}]})
    wait_for_topics(page, 1)
    assert shown(page) == []
    fake.tell({"type": "topics", "topics": [ROBOT]})
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/robot_description")


def test_a_robot_that_the_user_has_added_is_not_added_again(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [{**ROBOT, "publishers": 0}]})
    wait_for_topics(page, 1)
    page.select_option("#topic", "/robot_description")
    page.click("#add-display")
    fake.wait_for(lambda c: c["type"] == "add")
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    wait_for_topics(page, 2)
    assert shown(page) == ["/robot_description"]
    assert len(added(fake, kind="robot_model")) == 1


def test_a_display_that_is_added_twice_is_there_once(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [SCAN]})
    wait_for_topics(page, 1)
    page.click("#add-display")
    fake.wait_for(lambda c: c["type"] == "add" and c["topic"] == "/scan")
    page.click("[aria-label='Hide /scan']")
    page.click("#add-display")  # shows it again
    assert shown(page) == ["/scan"]
    assert page.get_attribute("[aria-label='Hide /scan']", "aria-pressed") == "false"
    page.select_option("#topic", label="robot from a parameter or file")
    page.dblclick("#add-display")
    fake.wait_for(lambda c: c["type"] == "add" and c["kind"] == "robot_model")
    assert shown(page) == ["/scan", "robot model"]
    page.locator("#display-list summary").last.click()
    node = page.get_by_label("Node of the parameter")
    node.fill("/other")
    node.press("Enter")
    page.click("#add-display")
    assert shown(page) == ["/scan", "robot model", "robot model"]
    assert len(added(fake, topic="/scan")) == 1


@pytest.mark.parametrize("displays", [[], [{"kind": "laser_scan", "topic": "/scan"}]])
def test_a_loaded_view_says_itself_what_is_shown(fake, open_view, displays):
    view = {
        "type": "view",
        "fixed": "",
        "displays": displays,
        "show": {},
        "text": "",
        "first": True,
    }
    fake.tell(view)
    page = open_view(fake.url)
    fake.tell({"type": "topics", "topics": [ROBOT, SCAN]})
    wait_for_topics(page, 2)
    assert shown(page) == [each["topic"] for each in displays]
    assert added(fake, kind="robot_model") == []


def test_a_robot_on_the_wire_comes_to_a_page_that_is_open(robot, viewer, open_view):
    page = open_view(viewer.url)
    robot.send("base", "tip", (0, 1, 0), 0, static=True)
    page.wait_for_selector("#tree .row:has-text('tip')")
    latched = QoS(durability=Durability.TRANSIENT_LOCAL)
    described = robot.publisher("/robot_description", "std_msgs/msg/String", latched)
    text = URDF.format(mesh="package://missing/tip.stl")
    described.publish(msg.serialize(msg.get_message("std_msgs/msg/String")(data=text)))
    page.wait_for_selector("#display-list .title b:text-is('/robot_description')")
    page.wait_for_selector("#display-list .status:has-text('package://missing/tip.stl')")


CRANE = """<robot name="crane">
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
    (package / "crane.urdf").write_text(CRANE.format(package="crane_description"))
    (package / "crane.urdf.xacro").write_text(
        CRANE.format(package="crane_description").replace('"boom"', '"$(arg hand)"')
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
