"""Descriptions of real robots, whole and spoilt, against urdfdom's own `check_urdf`."""

import os
import random
import re
import shutil
import subprocess
from xml.etree import ElementTree as ET

import pytest
from tests.places import ROOT

from turtlewire.urdf import Robot, UrdfError

CHECK_URDF = shutil.which("check_urdf", path="/usr/bin")  # not ours, which a venv has
FILES = sorted((ROOT / "build" / "corpus").rglob("*.urdf"))
#: What takes the place of a number.
NUMBERS = (
    "abc", "", " ", "1.5x", "nan", "inf", "1e999", "1e-400", "0x10", "1,5", "1.2.3", "--1", "+1",
    "-0", "-", ".", "1e", "0 0",
)  # fmt: skip

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not FILES, reason="needs scripts/corpus"),
    pytest.mark.skipif(CHECK_URDF is None, reason="needs apt install liburdfdom-tools"),
]


def links_of_urdfdom(path):
    """The names of the links, sorted; None if urdfdom refuses the file."""
    run = subprocess.run(
        [CHECK_URDF, path],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "LC_ALL": "C"},
    )
    if "Successfully Parsed" not in run.stdout:
        return None
    lines = re.findall(
        r"^root Link: (.*) has \d+ child|^ +child\(\d+\):  (.*)$", run.stdout, re.MULTILINE
    )
    return sorted(root or child for root, child in lines)


def links_of_ours(text):
    try:
        return sorted(Robot.from_xml(text).links)
    except UrdfError:
        return None


def spoil(root, draw):
    """Change a number, or remove an attribute or an element; return what was done."""
    parents = {child: parent for parent in root.iter() for child in parent}
    attributes = [(element, name) for element in root.iter() for name in element.attrib]
    numbers = [
        (element, name, number.span())
        for element, name in attributes
        for number in re.finditer(r"[-+.eE\d]*\d[-+.eE\d]*", element.attrib[name])
    ]
    what = draw.choice([kind for kind in (list(parents), attributes, numbers) if kind])
    if what is numbers:
        element, name, (start, end) = draw.choice(numbers)
        before = element.attrib[name]
        element.attrib[name] = before[:start] + draw.choice(NUMBERS) + before[end:]
        return f"{name}={element.attrib[name]!r} of {element.tag}"
    if what is attributes:
        element, name = draw.choice(attributes)
        return f"removed {name}={element.attrib.pop(name)!r} of {element.tag}"
    element = draw.choice(what)
    parents[element].remove(element)
    return f"removed {element.tag} {element.attrib}"


def test_robots_of_the_world_have_the_links_that_urdfdom_finds():
    assert len(FILES) > 150
    different = [
        str(path)
        for path in FILES
        if links_of_ours(path.read_bytes()) != links_of_urdfdom(str(path))
    ]
    assert different == []


def test_spoilt_descriptions_are_accepted_and_refused_as_by_urdfdom(tmp_path):
    draw = random.Random(1)
    path = tmp_path / "robot.urdf"
    different = []
    refused = 0
    whole = [text for text in (path.read_bytes().lstrip() for path in FILES) if links_of_ours(text)]
    for _ in range(1000):
        root = ET.fromstring(draw.choice(whole))
        what = spoil(root, draw)
        text = ET.tostring(root)
        path.write_bytes(text)
        theirs = links_of_urdfdom(str(path))
        refused += theirs is None
        if links_of_ours(text) != theirs:
            different.append(f"{root.attrib}: {what}")
    assert different == []
    assert 100 < refused < 900
