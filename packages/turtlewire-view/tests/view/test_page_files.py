"""What the page loads at its start.

What the view's page looks like, against pictures that were looked at.

``TURTLEWIRE_WRITE_GOLDEN=1`` rewrites them. They are compared as turtlesim's are.
"""

from __future__ import annotations

import hashlib
import posixpath
import re
from importlib.resources import files
from pathlib import Path

import pytest
from tests.needs import only_first_is_fast
from tests.pages import after_two_frames, difference, skip_with_other_fonts

from tests import places

from .fake_view import IDENTITY, pose
from .test_page import in_page

PAGE = Path(str(files("turtlewire_view") / "page"))
KIT = Path(str(files("turtlewire.web") / "kit"))
IMPORT = re.compile(r"^import\b[^;]*?from\s*\"([^\"]+)\"|\bfrom\"(\./[^\"]+)\"", re.MULTILINE)
THREE = "vendor/three-0.185.1/"


def imported(name: str) -> set[str]:
    """What a module imports, as paths from the page."""
    file = KIT.parent / name if name.startswith("kit/") else PAGE / name
    names = [a or b for a, b in IMPORT.findall(file.read_text("utf-8"))]
    known = {"three": THREE + "three.module.min.js"}
    return {
        known.get(each)
        or (
            each.replace("three/", THREE, 1)
            if each.startswith("three/addons/")
            else posixpath.normpath(posixpath.join(posixpath.dirname(name), each))
        )
        for each in names
    }


def test_the_page_names_all_its_modules_beforehand():
    found, waiting = set(), ["js/main.js"]
    while waiting:
        name = waiting.pop()
        new = imported(name) - found
        found |= new
        waiting += new
    links = re.findall(
        r'rel="modulepreload" href="([^"]+)"', (PAGE / "index.html").read_text("utf-8")
    )
    assert sorted(links) == sorted(found), "change the links in page/index.html"


# The vendored three.js is what npm's package holds, byte for byte, and nothing else.


VENDOR = files("turtlewire_view") / "page" / "vendor" / "three-0.185.1"
OURS = {"VENDOR.md", "SHA256SUMS"}


def found(folder, above: str = "") -> dict[str, bytes]:
    """Path to content of every file below a folder."""
    contents = {}
    for entry in folder.iterdir():
        name = f"{above}{entry.name}"
        contents |= found(entry, f"{name}/") if entry.is_dir() else {name: entry.read_bytes()}
    return contents


def test_files_are_those_of_the_package():
    listed = dict(
        reversed(line.split("  ./"))
        for line in (VENDOR / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    )
    contents = found(VENDOR)
    sums = {
        path: hashlib.sha256(content).hexdigest()
        for path, content in contents.items()
        if path not in OURS
    }
    assert sums == listed


def test_name_and_licence_are_printed():
    contents = found(VENDOR)
    assert b"sha512-5aojFCXKwnjBRZvUnt3WFfEcvUJgkN5LlijRFN95hMy8" in contents["VENDOR.md"]
    assert b"MIT License" in contents["LICENSE"]
    assert b"REVISION" in contents["three.module.min.js"]


GOLDEN = places.GOLDEN / "view"
WORST_CELL = 6
SIZES = {"desktop": (1200, 800), "phone": (360, 740), "landscape": (740, 360)}
PARENTS = {
    "world": "",
    "turtle1": "world",
    "turtle2": "world",
    "carrot1": "turtle1",
    "camera": "turtle2",
    "map": "",
    "odom": "map",
}
POSES = [
    IDENTITY,
    pose(5.5, 5.5, yaw=0.6),
    pose(3, 2, yaw=1.2),
    pose(7, 7, yaw=0.6),
    pose(3.3, 2.9, 0.8, yaw=1.2),
    IDENTITY,
    pose(2, 1),
]
MOVING = {"publisher": "/broadcaster", "static": False, "samples": 620, "rate": 62.4}
ROWS = [
    {"name": name, "parent": parent, **MOVING, "age": 0.012, "delay": 0.001}
    for name, parent in PARENTS.items()
    if parent
]
TIME = {"now": 20.0, "oldest": 10.0, "newest": 20.0, "live": True, "playing": True, "speed": 1.0}
RELATION = {
    "target": "world",
    "source": "carrot1",
    "translation": [7.0, 7.0, 0.0],
    "rotation": [0.0, 0.0, 0.296, 0.955],
    "rpy": [0.0, 0.0, 0.6],
    "matrix": [[0.825, -0.565, 0, 7], [0.565, 0.825, 0, 7], [0, 0, 1, 0], [0, 0, 0, 1]],
    "sentence": "carrot1 is 7.00 m ahead and 7.00 m to the left of world, and looks 34° further "
    "to the left.",
}


@pytest.fixture
def told(fake):
    fake.names(PARENTS)
    fake.frames(POSES)
    fake.tell({"type": "tree", "now": 20.0, "rows": ROWS})
    fake.tell({"type": "time", **TIME, "simulated": False})
    topics = [{"name": "/scan", "type": "sensor_msgs/msg/LaserScan", "kind": "laser_scan"}]
    fake.tell({"type": "topics", "topics": topics})
    return fake


@pytest.mark.parametrize("scheme", only_first_is_fast("light", "dark"))
@pytest.mark.parametrize("size", only_first_is_fast(*SIZES))
def test_every_size_and_scheme(told, open_view, size, scheme):
    width, height = SIZES[size]
    page = open_view(told.url, viewport={"width": width, "height": height}, color_scheme=scheme)
    page.wait_for_selector("#add-display:enabled")
    page.click("#tree .row:has(.name:text-is('carrot1'))")
    told.tell({"type": "relation", **RELATION})
    page.wait_for_selector(f"#sentence:text('{RELATION['sentence']}')")
    page.evaluate("() => { document.activeElement.blur(); scrollTo(0, 0); }")
    page.mouse.move(0, 0)
    in_page(page, "stage.labels.refresh(); stage.view.draw(performance.now());")
    after_two_frames(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    box = page.locator("#viewport").bounding_box()
    assert box["width"] > 300
    assert box["height"] > 200
    skip_with_other_fonts(page)
    assert difference(page, GOLDEN / f"{size}-{scheme}.png", page.screenshot()) < WORST_CELL
