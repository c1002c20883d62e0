"""What stands beside the picture of the view: tree, relation, time, displays."""

from __future__ import annotations

import math

import pytest

from .fake_view import IDENTITY, pose
from .test_page import in_page

PARENTS = {"world": "", "turtle1": "world", "turtle2": "world", "carrot1": "turtle1"}
POSES = [IDENTITY, pose(5, 5), pose(2, 1), pose(6, 6)]


def row(name: str, parent: str, **fields):
    known = {"publisher": f"/{name}_broadcaster", "static": False, "samples": 600}
    numbers = {"rate": 62.4, "age": 0.012, "delay": 0.0014}
    return {"name": name, "parent": parent, **known, **numbers, **fields}


ROWS = [
    row("turtle1", "world"),
    row("turtle2", "world", age=2.5),
    row("carrot1", "turtle1", static=True, rate=None, age=None, delay=None),
]
RELATION = {
    "type": "relation",
    "target": "world",
    "source": "turtle2",
    "translation": [2.0, 1.0, 0.0],
    "rotation": [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)],
    "rpy": [0.0, 0.0, math.pi / 2],
    "matrix": [[0, -1, 0, 2], [1, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]],
    "sentence": "turtle2 is 2.00 m ahead and 1.00 m to the left of world, and looks 90° left.",
    "path": ["turtle2", "world"],
}


@pytest.fixture
def told(fake):
    """The tutorial's frames."""
    fake.names(PARENTS)
    fake.frames(POSES, stamps=[0, 5, 5, 5])
    fake.tell({"type": "tree", "now": 5.0, "rows": ROWS})
    return fake


@pytest.fixture
def page(told, open_view):
    page = open_view(told.url)
    page.wait_for_selector("#tree .row:has-text('Hz')")
    return page


def shown(page) -> list[str]:
    """Names in the tree from above to below."""
    return page.evaluate("""() => [...document.querySelectorAll('#tree .row')]
        .sort((a, b) => parseFloat(a.style.top) - parseFloat(b.style.top))
        .map((row) => row.querySelector('.name').textContent)""")


def reading(page, name: str) -> str:
    return page.inner_text(f"#tree .row:has(.name:text-is('{name}')) small")


def test_the_tree_tells_rate_age_publisher_and_what_is_static(page):
    assert shown(page) == ["world", "turtle1", "carrot1", "turtle2"]
    assert reading(page, "world") == "root"
    assert reading(page, "turtle1") == "62 Hz · 12 ms old · /turtle1_broadcaster"
    assert reading(page, "turtle2") == "62 Hz · 2.5 s old · /turtle2_broadcaster"
    assert reading(page, "carrot1") == "static · /carrot1_broadcaster"
    kinds = page.evaluate("""() => Object.fromEntries([...document.querySelectorAll('.row')]
        .map((row) => [row.querySelector('.name').textContent, row.dataset.kind]))""")
    expected = {"world": "root", "turtle1": "live", "turtle2": "stale", "carrot1": "static"}
    assert kinds == expected


@pytest.mark.slow
def test_search_finds_names_and_publishers(page):
    page.fill("#search", "TURTLE")
    assert shown(page) == ["turtle1", "turtle2"]
    assert page.inner_text("mark >> nth=0") == "turtle"
    page.fill("#search", "carrot1_broad")
    assert shown(page) == ["carrot1"]
    assert reading(page, "carrot1").startswith("below turtle1")
    page.fill("#search", "nothing")
    assert shown(page) == []
    assert page.inner_text("#no-match") == "No frame or publisher matches."
    page.fill("#search", "")
    assert not page.is_visible("#no-match")
    assert len(shown(page)) == 4


def test_branches_are_folded(page):
    page.click("[aria-label='Fold turtle1']")
    assert shown(page) == ["world", "turtle1", "turtle2"]
    page.click("[aria-label='Unfold turtle1']")
    assert len(shown(page)) == 4


def test_the_tree_is_used_with_keys_alone(page, fake):
    page.focus("#tree")
    for key in ("Home", "ArrowDown", "ArrowLeft", "ArrowDown", "Enter"):
        page.keyboard.press(key)
    assert shown(page) == ["world", "turtle1", "turtle2"]
    fake.wait_for(lambda c: c["type"] == "relation" and c.get("source") == "turtle2")


def active(page) -> str:
    """The frame that the keyboard is at, as a screen reader is told."""
    return page.evaluate("""() => {
        const id = document.getElementById("tree").getAttribute("aria-activedescendant");
        const row = document.getElementById(id);
        const name = row.querySelector(".name").textContent;
        return `${name}, ${row.getAttribute("aria-description")}`;
    }""")


@pytest.mark.slow
def test_arrow_keys_go_in_and_out_of_branches(page):
    page.click("#tree .row:has(.name:text-is('turtle1'))")
    assert active(page).startswith("turtle1, 62 Hz")
    page.focus("#tree")
    page.keyboard.press("ArrowRight")
    assert active(page).startswith("carrot1, static")
    page.keyboard.press("ArrowLeft")
    assert active(page).startswith("turtle1")
    assert "carrot1" in shown(page)
    page.keyboard.press("ArrowLeft")
    assert "carrot1" not in shown(page)
    page.keyboard.press("ArrowRight")
    assert "carrot1" in shown(page)


@pytest.mark.slow
def test_the_selected_row_stays_in_sight_when_the_numbers_open(fake, open_view):
    names = {"world": "", **{f"link{number}": "world" for number in range(30)}}
    fake.names(names)
    fake.frames([IDENTITY] * len(names), stamps=[0] + [5] * 30)
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row")
    bottom = page.evaluate("document.getElementById('tree').getBoundingClientRect().bottom")
    last = max(
        (each for each in page.locator("#tree .row").all()
         if each.bounding_box()["y"] + each.bounding_box()["height"] <= bottom),
        key=lambda each: each.bounding_box()["y"],
    )  # fmt: skip
    name = last.locator(".name").inner_text()
    last.click()
    fake.tell({**RELATION, "source": name, "sentence": "far " * 40})
    page.click("#numbers summary")
    page.wait_for_function(
        """([name, former]) => {
            const tree = document.getElementById("tree").getBoundingClientRect();
            const row = [...document.querySelectorAll("#tree .row")]
                .find((each) => each.title === name)?.getBoundingClientRect();
            return tree.bottom < former - 5 && row && row.bottom <= tree.bottom + 1;
        }""",
        arg=[name, bottom],
    )


def test_a_phone_reads_nothing_of_keys(told, open_view):
    page = open_view(told.url, has_touch=True, is_mobile=True)
    assert page.locator("#help li:visible").count() == 2
    assert "Shift" not in page.locator("#help").inner_text()


@pytest.mark.slow
def test_frames_are_hidden_by_a_regular_expression_or_one_by_one(page):
    hidden = "return [...frames.hidden]"
    page.fill("#hide", "^turtle[12]$")
    assert in_page(page, hidden) == [0, 1, 1, 0]
    page.hover("#tree .row:has(.name:text-is('turtle1'))")
    page.click("[aria-label='Hide turtle1']")
    assert in_page(page, hidden) == [0, 0, 1, 0]
    page.fill("#hide", "[")
    assert page.get_attribute("#hide", "aria-invalid") == "true"
    assert "Invalid regular expression" in page.inner_text("#hide-problem")
    assert in_page(page, hidden) == [0, 0, 1, 0]  # as before
    page.fill("#hide", "")
    assert in_page(page, hidden) == [0, 0, 0, 0]


def test_thousands_of_frames_are_few_elements(fake, open_view):
    names = {"map": "", **{f"frame{k}": "map" for k in range(4000)}}
    fake.names(names)
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row:has-text('frame0')")
    assert shown(page)[:3] == ["map", "frame0", "frame1"]
    assert len(shown(page)) < 40
    page.focus("#tree")
    page.keyboard.press("End")
    page.wait_for_selector("#tree .row:has-text('frame3999')")
    assert len(shown(page)) < 40
    assert "4001" in page.inner_text("#frame-count")


def test_the_relation_in_words_and_numbers(page, fake):
    page.click("#tree .row:has(.name:text-is('turtle2'))")
    fake.tell(RELATION)
    page.wait_for_selector(f"#sentence:text('{RELATION['sentence']}')")
    page.click("#numbers summary")
    numbers = page.inner_text("#number-list")
    for text in ("2.000, 1.000, 0.000 m", "0.000, 0.000, 0.707, 0.707", "1.571 rad", "90.0"):
        assert text in numbers
    cells = page.locator("#matrix td").all_inner_texts()
    assert [float(cell) for cell in cells] == [
        number for row in RELATION["matrix"] for number in row
    ]
    facts = page.inner_text("#facts").split("\n")
    assert dict(zip(facts[::2], facts[1::2], strict=True)) == {
        "parent": "world",
        "published by": "/turtle2_broadcaster",
        "rate": "62 Hz",
        "age": "2.5 s old",
        "delay": "1.4 ms",
        "samples": "600",
    }


def test_a_publisher_that_left_is_marked(page, fake):
    page.click("#tree .row:has(.name:text-is('turtle1'))")
    gone = {**row("turtle1", "world", age=0.1), "publisher": "/gone", "departed": True}
    fake.tell({"type": "tree", "now": 5.0, "rows": [gone]})
    page.wait_for_selector("#facts dd:text('/gone (has left)')")
    page.wait_for_selector("#tree .row[data-kind='stale']:has-text('/gone (has left)')")


def test_values_rounded_to_zero_have_no_sign(page, fake):
    page.click("#tree .row:has(.name:text-is('turtle2'))")
    small = [[-1e-9] * 4 for _ in range(4)]
    fake.tell({**RELATION, "translation": [-1e-9, -0.001, 0.0], "matrix": small})
    page.click("#numbers summary")
    page.wait_for_function(
        "() => document.querySelector('#number-list dd').textContent === '0.000, -0.001, 0.000 m'"
    )
    assert page.inner_text("#matrix td >> nth=0") == "0.000"


@pytest.mark.slow
def test_why_a_relation_is_not_known(page, fake):
    page.click("#tree .row:has(.name:text-is('turtle2'))")
    page.select_option("#relation-target", "carrot1")
    fake.wait_for(lambda c: c["type"] == "relation" and c["target"] == "carrot1")
    failure = {"error": "They are not connected.", "hint": "Publish map → odom."}
    fake.tell({"type": "relation", "target": "carrot1", "source": "turtle2", **failure})
    page.wait_for_selector("#sentence[data-error]:text('They are not connected.')")
    assert page.inner_text("#hint") == "Publish map → odom."
    assert page.is_hidden("#numbers")
    page.click("#swap")
    fake.wait_for(lambda c: (c.get("target"), c.get("source")) == ("turtle2", "carrot1"))
    text = "They do not move.  Requested time 17 but the latest data is at time 3, when looking up"
    fake.tell({"type": "relation", "target": "turtle2", "source": "carrot1", "error": text})
    page.wait_for_selector("#sentence summary:text('They do not move.')")
    assert page.inner_text("#sentence") == "They do not move."
    page.click("#sentence summary")
    assert "Requested time 17" in page.inner_text("#sentence")


def test_non_finite_numbers_are_reported(page, fake):
    page.click("#tree .row:has(.name:text-is('turtle2'))")
    nothing = {"translation": [None, 1.0, 0.0], "rpy": [None] * 3, "matrix": [[None] * 4] * 4}
    fake.tell({**RELATION, **nothing, "rotation": [None] * 4})
    page.wait_for_selector("#sentence:not([data-empty])")
    page.click("#numbers summary")
    assert "not finite, 1.000, 0.000 m" in page.inner_text("#number-list")


def test_the_fixed_frame_is_chosen_or_automatic(page, fake):
    assert page.inner_text("#fixed option:checked") == "automatic (world)"
    page.select_option("#fixed", "turtle1")
    fake.wait_for(lambda c: c == {"type": "fixed", "frame": "turtle1"})
    page.click("#tree .row:has(.name:text-is('carrot1'))")
    page.click("#use-fixed")
    fake.wait_for(lambda c: c == {"type": "fixed", "frame": "carrot1"})
    page.select_option("#fixed", "")
    fake.wait_for(lambda c: c == {"type": "fixed", "frame": ""})


def test_the_fixed_frame_of_the_command_line_is_shown(fake, open_view):
    fake.names(PARENTS, fixed="turtle1")
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row:has-text('turtle2')")
    assert page.input_value("#fixed") == "turtle1"
    assert page.inner_text("#relation-target option:checked") == "turtle1"


LIVE = {"now": 20.0, "oldest": 10.0, "newest": 20.0, "live": True, "playing": True, "speed": 1.0}


def test_live_time_is_paused_scrubbed_and_goes_on(page, fake):
    fake.tell({"type": "time", **LIVE, "simulated": False})
    page.wait_for_selector("#now[data-live]")
    assert page.is_hidden("#speed")
    page.click("#pause")
    fake.wait_for(lambda c: c == {"type": "pause"})
    fake.tell({"type": "time", **LIVE, "live": False, "playing": False, "now": 16.5})
    page.wait_for_selector("#clock:text('3.5 s ago')")
    assert page.get_attribute("#pause", "aria-label") == "Go on"
    page.focus("#scrub")
    page.keyboard.press("Home")
    fake.wait_for(lambda c: c == {"type": "seek", "stamp": 10})
    page.click("#now")
    fake.wait_for(lambda c: c == {"type": "play"})


def test_nothing_grows_older_while_the_time_stands_still(page, fake):
    fake.tell({"type": "time", **LIVE, "live": False, "playing": False})
    page.wait_for_selector("#clock:text('paused')")
    ages = in_page(
        page,
        """
        const before = frames.ages.tick();
        await new Promise((done) => setTimeout(done, 60));
        return [before, frames.ages.tick()];
        """,
    )
    assert ages[0] == ages[1]
    fake.tell({"type": "tree", "now": 9.0, "rows": [row("turtle1", "world", age=4.0)]})
    fake.tell({"type": "status", "id": None, "level": "ok", "text": "after it"})
    page.wait_for_selector("#notice:text('after it')")
    assert "12 ms old" in reading(page, "turtle1")


def test_a_bag_is_played_at_any_speed(fake, open_view):
    fake.tell({"type": "hello", "source": {"kind": "bag", "name": "walk.mcap"}})
    fake.tell({"type": "time", **LIVE, "live": False, "playing": False, "now": 12.0})
    page = open_view(fake.url)
    page.wait_for_selector("#clock:text('2.00 of 10.00 s')")
    fake.names(PARENTS)
    fake.tell({"type": "tree", "now": 5.0, "rows": ROWS})
    page.wait_for_selector("#tree .row:has-text('turtle2') >> text='62 Hz · /turtle2_broadcaster'")
    assert page.inner_text("#source") == "walk.mcap"
    assert page.get_attribute("#pause", "aria-label") == "Play"
    page.keyboard.press("Space")
    fake.wait_for(lambda c: c == {"type": "play"})
    page.select_option("#speed", "2")
    fake.wait_for(lambda c: c == {"type": "speed", "factor": 2})


def test_names_with_markup_are_texts(fake, open_view):
    name = "<img src=x onerror=alert(1)>&amp;"
    fake.names({name: "", "<b>bold</b>": name})
    fake.frames([IDENTITY, pose(1, 0)])
    fake.tell({"type": "error", "text": "<i>refused</i>"})
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row:has-text('bold')")
    assert shown(page) == [name, "<b>bold</b>"]
    assert page.inner_text("#notice") == "<i>refused</i>"
    assert page.locator("#tree img, #tree b, #notice i").count() == 0


def test_choosing_a_frame_moves_nothing(page, fake):
    boxes = """() => ['#viewport', '#frames', '#relation', '#displays', '#time'].map((part) => {
        const { left, top, width, height } = document.querySelector(part).getBoundingClientRect();
        return [left, top, width, height];
    })"""
    before = page.evaluate(boxes)
    page.click("#tree .row:has(.name:text-is('turtle2'))")
    fake.tell(RELATION)
    page.wait_for_selector(f"#sentence:text('{RELATION['sentence']}')")
    page.wait_for_selector("#facts dt")
    assert page.evaluate(boxes) == before


def test_topics_are_offered_and_others_are_named(page, fake):
    topics = [
        {"name": "/scan10", "type": "sensor_msgs/msg/LaserScan", "kind": "laser_scan"},
        {"name": "/scan2", "type": "sensor_msgs/msg/LaserScan", "kind": "laser_scan"},
        {"name": "/rosout", "type": "rcl_interfaces/msg/Log", "kind": None},
    ]
    fake.tell({"type": "topics", "topics": topics})
    page.wait_for_selector("#add-display:enabled")
    offered = page.locator("#topic option").all_inner_texts()
    robot = "robot from a parameter or file"
    assert offered == ["/scan2 (laser scan)", "/scan10 (laser scan)", robot]
    assert page.inner_text("#other-topics") == "No display shows: /rosout"


@pytest.mark.slow
def test_a_display_that_the_page_cannot_draw_says_so(page, fake):
    fake.tell({"type": "topics", "topics": [{"name": "/x", "type": "y", "kind": "no_such_kind"}]})
    page.wait_for_selector("#add-display:enabled")
    page.click("#add-display")
    page.wait_for_selector(".display[data-level=error]")
    assert "no_such_kind" in page.inner_text(".display .status")
    page.click("[aria-label='Remove /x']")
    fake.wait_for(lambda c: c["type"] == "remove")
    assert page.locator(".display").count() == 0


def test_before_anything_moves_there_is_no_time(page, fake):
    nothing = {"now": 0.0, "oldest": 0.0, "newest": 0.0}
    fake.tell({"type": "time", **LIVE, **nothing, "simulated": True})
    page.wait_for_selector("#clock:text('nothing moves yet')")
    assert page.is_disabled("#scrub")


def test_the_budget_of_points_follows_the_time_of_pictures(page, fake):
    fake.wait_for(lambda c: c["type"] == "budget")
    told = in_page(
        page,
        """
        const { Budget } = await import(new URL('js/budget.js', location.href));
        const told = [];
        const budget = new Budget(true, ({ points }) => told.push(points));
        for (const time of [80, 30, 17]) for (let n = 0; n < 20; n += 1) budget.take(time);
        for (let n = 0; n < 4000; n += 1) budget.take(500);
        return [told[0], told[1], told.at(-1)];
        """,
    )
    assert told == [28_000, 35_000, 5_000]


#: Lines that pass by themselves stay, so that only what the page does ends them.
FOR_EVER = """
const plain = window.setTimeout;
window.setTimeout = (call, ms, ...rest) => plain(call, ms >= 5000 ? 2 ** 30 : ms, ...rest);
"""


def test_a_good_file_ends_what_was_said_of_the_refused_one(fake, open_view):
    fake.names(PARENTS)
    page = open_view(fake.url, FOR_EVER)
    page.wait_for_selector("#tree .row")
    fake.tell({"type": "error", "text": "This is no view: it is empty."})
    page.wait_for_selector("#notice:text('This is no view')")
    fake.tell({"type": "view", "fixed": "", "displays": [], "show": {}, "text": ""})
    page.wait_for_selector("#notice", state="hidden")


def test_a_line_that_does_not_pass_stands_again_after_one_that_does(fake, open_view):
    page = open_view(fake.url)
    fake.tell({"type": "status", "id": None, "level": "error", "text": "The bag has no frames."})
    page.wait_for_selector("#notice:text('The bag has no frames.')")
    fake.tell({"type": "error", "text": "Nothing was published."})
    page.wait_for_selector("#notice:text('Nothing was published.')")
    page.wait_for_selector("#notice[data-level=error]:text('The bag has no frames.')")


@pytest.mark.slow
def test_a_bag_without_transforms_is_not_waited_for(fake, open_view):
    fake.tell({"type": "hello", "source": {"kind": "bag", "name": "walk.mcap"}})
    page = open_view(fake.url)
    page.wait_for_selector("#no-frames:text('The bag has no transforms.')")


@pytest.mark.slow
def test_tools_that_publish_say_why_they_do_not_in_a_bag(fake, open_view):
    why = "You cannot publish into a bag."
    fake.tell({"type": "hello", "source": {"kind": "bag", "name": "walk.mcap"}})
    fake.names(PARENTS)
    page = open_view(fake.url)
    page.wait_for_selector("#tree .row")
    for tool in ("point", "pose_estimate", "goal"):
        assert page.get_attribute(f"[data-tool={tool}]", "title") == why
        page.click(f"[data-tool={tool}]", force=True)
        page.wait_for_selector(f"#notice:text('{why}')")
        assert page.get_attribute(f"[data-tool={tool}]", "aria-pressed") == "false"
    page.keyboard.press("g")
    assert page.get_attribute("[data-tool=goal]", "aria-pressed") == "false"
    page.click("[data-tool=measure]")
    assert page.get_attribute("[data-tool=measure]", "aria-pressed") == "true"
    fake.tell({"type": "hello", "source": {"kind": "live", "name": "domain 7"}})
    page.wait_for_selector("[data-tool=goal][aria-disabled=false]")
    page.click("[data-tool=goal]")
    assert page.get_attribute("[data-tool=goal]", "aria-pressed") == "true"
