"""What the view's page looks like, against pictures that were looked at.

``TURTLEWIRE_WRITE_GOLDEN=1`` rewrites them. They are compared as turtlesim's are.
"""

from __future__ import annotations

import pytest
from tests.pages import after_two_frames, difference, skip_with_other_fonts

from tests import places

from .fake_view import IDENTITY, pose
from .test_page import in_page

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


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
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
