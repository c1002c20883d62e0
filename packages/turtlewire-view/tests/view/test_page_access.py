"""The view for people who see badly, use a keyboard or a screen reader, or a small screen."""

from __future__ import annotations

import pytest
from tests.pages import (
    UNREAD_NAMES,
    root_size_with,
    small_texts,
    wait_until,
    weak_borders,
    weak_rings,
    weak_texts,
)

from .conftest import SIZES
from .fake_view import IDENTITY, pose
from .test_page import camera_of, in_page, on_screen, press

pytestmark = pytest.mark.slow

PARENTS = {"world": "", "base": "world", "arm": "base", "hand": "arm", "beacon": "world"}
POSES = [IDENTITY, pose(3, 0, 0), pose(3, 2, 1), pose(3, 3, 1), pose(-1, 3, 0)]
ROWS = [
    {"name": name, "parent": parent, "publisher": "/robot", "static": False, "samples": 9}
    | {"rate": 62.4, "age": 0.012, "delay": 0.001}
    for name, parent in PARENTS.items()
    if parent
]
RELATION = {
    "target": "world",
    "source": "arm",
    "translation": [3, 2, 1],
    "rotation": [0, 0, 0, 1],
    "rpy": [0, 0, 0],
    "matrix": [[1, 0, 0, 3], [0, 1, 0, 2], [0, 0, 1, 1], [0, 0, 0, 1]],
    "sentence": "arm is there.",
}
#: Left, top, right and bottom of elements in the window [px].
BOXES = """(selector) => [...document.querySelectorAll(selector)]
    .filter((each) => each.checkVisibility())
    .map((each) => each.getBoundingClientRect())
    .map(({ left, top, right, bottom }) => [left, top, right, bottom])"""


@pytest.fixture
def told(fake):
    fake.names(PARENTS)
    fake.frames(POSES)
    fake.tell({"type": "tree", "now": 5.0, "rows": ROWS})
    times = {"now": 5.0, "oldest": 1.0, "newest": 5.0, "live": True, "playing": True, "speed": 1.0}
    fake.tell({"type": "time", **times, "simulated": False})
    topics = [{"name": "/map", "type_name": "nav_msgs/msg/OccupancyGrid", "publishers": 1}]
    fake.tell({"type": "topics", "topics": [{**topics[0], "kind": "occupancy_grid"}]})
    return fake


def opened(told, open_view, size="desktop", **options):
    width, height = SIZES[size]
    page = open_view(told.url, viewport={"width": width, "height": height}, **options)
    page.wait_for_selector("#tree .row:has-text('Hz')")
    page.wait_for_selector("#add-display:enabled")
    in_page(page, "while (!frames.known[4]) await new Promise(requestAnimationFrame);")
    return page


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_focused_elements_are_visible(told, open_view, scheme):
    page = opened(told, open_view, color_scheme=scheme)
    page.click("#looks summary")
    assert weak_rings(page) == {}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_input_fields_have_a_visible_border(told, open_view, scheme):
    page = opened(told, open_view, color_scheme=scheme)
    assert weak_borders(page) == {}


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_texts_stand_out(told, open_view, scheme):
    page = opened(told, open_view, color_scheme=scheme)
    page.click("#add-display")
    page.click("[aria-label='Hide beacon']")
    page.click("#tree .row:has(.name:text-is('arm'))")
    page.hover("#tree .row:has(.name:text-is('base'))")
    told.tell({"type": "relation", **RELATION})
    page.click("#numbers summary")
    page.click("#looks summary")
    assert weak_texts(page) == []


@pytest.mark.parametrize("size", SIZES)
def test_no_text_is_smaller_than_12_px(told, open_view, size):
    page = opened(told, open_view, size)
    page.click("#looks summary")
    page.click("#add-display")
    page.wait_for_selector(".display details")
    assert small_texts(page) == []


def test_names_are_where_a_screen_reader_reads_them(told, open_view):
    assert opened(told, open_view).evaluate(UNREAD_NAMES) == []


def test_the_size_of_texts_in_the_browser_counts(told, open_view):
    page = opened(told, open_view)
    assert root_size_with(page, 16) == pytest.approx(15)
    assert root_size_with(page, 24) == pytest.approx(22.5)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("state", ["live", "lost"])
def test_the_state_is_read_whole_at_every_width(told, open_view, size, state):
    page = opened(told, open_view, size)
    long = "automatic (a_frame_with_a_very_long_name_indeed_base_link)"
    page.evaluate("(text) => document.querySelector('#fixed option').textContent = text", long)
    if state == "lost":
        told.close()
        page.wait_for_selector("#connection[data-state=lost]")
    width = SIZES[size][0]
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for left, _, right, _ in page.evaluate(BOXES, "header > *"):
        assert 0 <= left < right <= width
    cut = "({ scrollWidth, clientWidth }) => scrollWidth > clientWidth"
    assert not page.locator("#connection").evaluate(cut)


@pytest.mark.parametrize("size", SIZES)
def test_there_is_one_heading_of_the_page_at_every_width(told, open_view, size):
    page = opened(told, open_view, size)
    heading = page.get_by_role("heading", level=1)
    assert [heading.count(), heading.inner_text()] == [1, "view"]


def test_rows_have_names_that_stay_and_say_where_they_are(told, open_view):
    page = opened(told, open_view)
    rows = page.get_by_role("treeitem")
    base = page.get_by_role("treeitem", name="base", exact=True)
    assert base.get_attribute("aria-description") == "62 Hz · 12 ms old · /robot"
    places = {
        name: [
            page.get_by_role("treeitem", name=name, exact=True).get_attribute(f"aria-{word}")
            for word in ("level", "posinset", "setsize")
        ]
        for name in PARENTS
    }
    assert places == {
        "world": ["1", "1", "1"],
        "base": ["2", "1", "2"],
        "beacon": ["2", "2", "2"],
        "arm": ["3", "1", "1"],
        "hand": ["4", "1", "1"],
    }
    page.fill("#search", "ba")
    assert rows.count() == 1
    page.fill("#search", "a")
    for n, name in enumerate(["arm", "base", "beacon", "hand"]):
        row = page.get_by_role("treeitem", name=name, exact=True)
        words = [row.get_attribute(f"aria-{word}") for word in ("level", "posinset", "setsize")]
        assert words == ["1", f"{n + 1}", "4"]


def test_rows_and_columns_of_the_matrix_have_names(told, open_view):
    page = opened(told, open_view)
    page.click("#tree .row:has(.name:text-is('arm'))")
    told.tell({"type": "relation", **RELATION})
    page.click("#numbers summary")
    table = page.get_by_role("table")
    assert table.get_by_role("rowheader").all_inner_texts() == ["x", "y", "z", "last row"]
    heads = table.get_by_role("columnheader").all_inner_texts()
    assert heads == ["row", "x axis", "y axis", "z axis", "origin"]
    assert page.locator("#matrix tbody tr").nth(1).locator("td").all_inner_texts() == [
        "0.000", "1.000", "0.000", "2.000",
    ]  # fmt: skip


def test_letters_are_no_shortcuts_when_they_are_switched_off(told, open_view):
    page = opened(told, open_view)
    page.click("#looks summary")
    assert page.is_checked("#letter-keys")
    page.uncheck("#letter-keys")
    page.keyboard.press("Escape")
    for key in ("t", "m", "/"):
        page.keyboard.press(key)
    assert page.get_attribute("#top", "aria-pressed") == "false"
    assert page.get_attribute("[data-tool=measure]", "aria-pressed") == "false"
    assert page.evaluate("document.activeElement.id") != "search"
    page.reload()
    page.wait_for_selector("#tree .row:has-text('Hz')")
    page.keyboard.press("t")
    assert page.get_attribute("#top", "aria-pressed") == "false"
    page.click("#looks summary")
    page.check("#letter-keys")
    page.keyboard.press("t")
    assert page.get_attribute("#top", "aria-pressed") == "true"


def test_keys_other_than_letters_work_with_letters_switched_off(told, open_view):
    page = opened(told, open_view)
    page.click("#tree .row:has(.name:text-is('arm'))")
    page.click("#looks summary")
    page.uncheck("#letter-keys")
    page.keyboard.press("Escape")
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press(" ")
    told.wait_for(lambda c: c["type"] == "pause")
    page.keyboard.press("Escape")
    told.wait_for(lambda c: c["type"] == "relation" and c["target"] is None)


def test_without_storage_the_letters_work(told, open_view):
    script = "Object.defineProperty(window, 'localStorage', { get() { throw Error('blocked'); } })"
    page = open_view(told.url, script)
    page.wait_for_selector("#tree .row:has-text('Hz')")
    page.keyboard.press("t")
    assert page.get_attribute("#top", "aria-pressed") == "true"
    page.click("#looks summary")
    page.uncheck("#letter-keys")
    page.keyboard.press("o")
    assert page.get_attribute("#top", "aria-pressed") == "true"


def selected(page) -> str:
    return page.input_value("#relation-source")


def test_escape_closes_show_before_it_does_anything_else(told, open_view):
    page = opened(told, open_view)
    page.click("#tree .row:has(.name:text-is('arm'))")
    page.click("[data-tool=measure]")
    page.click("#looks summary")
    page.focus("#size")
    page.keyboard.press("Escape")
    assert page.get_attribute("#looks", "open") is None
    assert page.evaluate("document.activeElement.matches('#looks summary')")
    assert page.get_attribute("[data-tool=measure]", "aria-pressed") == "true"
    assert selected(page) == "arm"
    page.keyboard.press("Escape")
    assert page.get_attribute("[data-tool=measure]", "aria-pressed") == "false"
    page.keyboard.press("Escape")
    assert selected(page) == ""


def test_a_press_outside_closes_show_before_it_does_anything_else(told, open_view):
    page = opened(told, open_view)
    page.click("#tree .row:has(.name:text-is('arm'))")
    page.click("#looks summary")
    page.click("#show-grid")
    assert page.get_attribute("#looks", "open") is not None  # a press inside
    press(page, POSES[4][:3])
    assert page.get_attribute("#looks", "open") is None
    assert selected(page) == "arm"
    press(page, POSES[4][:3])
    assert selected(page) == "beacon"
    page.click("#looks summary")
    page.click("#top")  # a button beside it does what it says
    assert page.get_attribute("#looks", "open") is None
    assert page.get_attribute("#top", "aria-pressed") == "true"


FOLLOWS = """async (place) => {
    const { stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    const at = stage.view.project(new Vector3(...place));
    const { width, height } = stage.view.viewport;
    return at && at.x > 0 && at.x < width && at.y > 0 && at.y < height;
}"""


@pytest.mark.parametrize("by", [(0, 0), (2, 1)])
def test_a_click_does_not_stop_the_camera_following(told, open_view, by):
    """Nor does the hand that trembles while it clicks."""
    page = opened(told, open_view)
    box = page.locator("#scene").bounding_box()
    x, y = on_screen(page, POSES[4][:3])
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    page.mouse.move(box["x"] + x + by[0], box["y"] + y + by[1])
    page.mouse.up()
    assert selected(page) == "beacon"
    assert in_page(page, "return stage.cameras.isTouched") is False
    far = [IDENTITY, *(pose(x + 4000, y, z) for x, y, z, *_ in POSES[1:])]
    for _ in range(3000):  # the page looks ten times a second where the frames are
        if page.evaluate(FOLLOWS, list(far[1][:3])):
            break
        told.frames(far)
    assert page.evaluate(FOLLOWS, list(far[1][:3]))


@pytest.mark.parametrize("how", ["drag", "wheel"])
def test_a_camera_that_was_moved_stays(told, open_view, how):
    page = opened(told, open_view)
    box = page.locator("#scene").bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 300)
    before = camera_of(page)
    if how == "wheel":
        page.mouse.wheel(0, -300)
    else:
        page.mouse.down()
        page.mouse.move(box["x"] + 360, box["y"] + 300, steps=4)
        page.mouse.up()
    touched = "async () => (await import('./js/main.js')).stage.cameras.isTouched"
    assert wait_until(page, touched)
    assert camera_of(page) != before


@pytest.mark.parametrize("size", SIZES)
def test_the_open_menu_lies_within_the_picture(told, open_view, size):
    page = opened(told, open_view, size)
    page.click("#looks summary")
    (left, top, right, bottom), picture = page.evaluate(BOXES, "#looks > div, #viewport")[::-1]
    assert picture[0] <= left < right <= picture[2]
    assert picture[1] <= top < bottom <= picture[3]
    page.click("#load-view", trial=True)  # it can be scrolled to


@pytest.mark.parametrize("size", SIZES)
def test_buttons_lie_beside_what_is_looked_at(told, open_view, size):
    """All frames are in the part of the picture that no button covers."""
    page = opened(told, open_view, size, has_touch=size != "desktop")
    picture = page.locator("#scene").bounding_box()
    covers = page.evaluate(BOXES, ".bar, #looks")
    for place in POSES:
        x, y = on_screen(page, place[:3])
        assert 0 <= x <= picture["width"]
        assert 0 <= y <= picture["height"]
        x, y = x + picture["x"], y + picture["y"]
        for left, top, right, bottom in covers:
            assert not (left <= x <= right and top <= y <= bottom), (place, size)


OVERLAPS = """
    const touch = ([l, r, t, b], [l2, r2, t2, b2]) => l < r2 && l2 < r && t < b2 && t2 < b;
    const { shown } = stage.labels;
    const pairs = shown.flatMap((one, k) => shown.slice(k + 1).map((other) => [one, other]));
    const bad = pairs.filter(([one, other]) => touch(one.box, other.box));
    return [shown.map(({ text }) => text), bad.map((pair) => pair.map(({ text }) => text))];
"""


def test_names_that_come_together_do_not_lie_on_one_another(told, open_view):
    """They are chosen four times a second, and frames move in between."""
    page = opened(told, open_view)
    apart = "stage.labels.refresh(); stage.view.draw(1e6);"
    names, _ = in_page(page, apart + OVERLAPS)
    assert {"arm", "beacon"} <= set(names)
    meet = "frames.poses.copyWithin(7 * 4, 7 * 2, 7 * 2 + 3); stage.view.draw(1e6 + 1);"
    names, overlaps = in_page(page, meet + OVERLAPS)
    assert overlaps == []
    assert ("arm" in names) != ("beacon" in names)


def test_the_selected_and_the_hovered_name_are_both_read(told, open_view):
    page = opened(told, open_view)
    page.click("#tree .row:has(.name:text-is('arm'))")
    page.hover("#tree .row:has(.name:text-is('hand'))")
    meet = "frames.poses.copyWithin(7 * 3, 7 * 2, 7 * 2 + 3); stage.labels.refresh();"
    names, overlaps = in_page(page, meet + "stage.view.draw(1e6);" + OVERLAPS)
    assert names[:2] == ["arm", "hand"]
    assert overlaps == []


@pytest.mark.parametrize("name", ["beacon", "a_link_whose_name_is_too_long_for_either_side"])
def test_names_stay_in_the_picture(fake, open_view, name):
    fake.names(dict(zip([*[*PARENTS][:4], name], PARENTS.values(), strict=True)))
    fake.frames(POSES)
    page = open_view(fake.url, viewport={"width": 320, "height": 640})
    in_page(page, "while (!frames.known[4]) await new Promise(requestAnimationFrame);")
    right = """
        const { Vector3 } = await import("three");
        stage.cameras.isTouched = true;
        const { width } = stage.view.viewport;
        const at = new Vector3(...frames.position(4)).project(stage.view.camera);
        const { x, y, z } = at.setX(1 - 4 / width).unproject(stage.view.camera);
        frames.poses.set([x, y, z], 7 * 4);
        stage.labels.refresh();
        stage.view.draw(1e6);
        const label = stage.labels.shown.find(({ text }) => text === frames.names[4]);
        return [...label.box.slice(0, 2), width];
    """
    left, end, width = in_page(page, right)
    assert 0 <= left < end <= width
