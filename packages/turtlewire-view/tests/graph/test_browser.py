"""The page of the graph in a real browser."""

import pytest
from tests.needs import only_first_is_fast
from tests.pages import (
    UNREAD_NAMES,
    root_size_with,
    small_texts,
    wait_until,
    weak_borders,
    weak_rings,
    weak_texts,
)

from turtlewire import msg

from ..view.conftest import SIZES
from .conftest import BEST_EFFORT, LIMIT_S, large

LOST = "#connection[data-state=lost]"


@pytest.fixture
def robot(nodes):
    """Two nodes that do not connect, and two that do."""
    nodes.publisher("lidar", "/scan", BEST_EFFORT)
    nodes.subscription("slam", "/scan")
    nodes.talker = nodes.publisher("talker", "/chatter")
    nodes.subscription("listener", "/chatter")
    return nodes


@pytest.fixture
def open_graph(browser, graph_page):
    """Opens the page in a window; fails the test when it reports an error."""
    contexts, errors = [], []

    def open_graph(size="desktop", **options):
        width, height = SIZES[size]
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        contexts.append(context)
        context.set_default_timeout(1000 * LIMIT_S)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.on("console", lambda said: errors.append(said.text) if said.type == "error" else None)
        page.goto(graph_page.url)
        page.wait_for_selector("#connection[data-state=live]")
        return page

    yield open_graph
    for context in contexts:
        context.close()
    # A connection that a test ends is reported as an error of the browser.
    assert [text for text in errors if "WebSocket" not in text] == []


@pytest.fixture
def page(robot, open_graph):
    page = open_graph()
    wait_for_robot(page)
    return page


def wait_for_robot(page):
    for key in ("node /lidar", "node /slam", "topic /scan", "node /listener", "topic /chatter"):
        page.wait_for_selector(f'#picture [data-key="{key}"]', state="attached")
    page.wait_for_selector("#picture .policy", state="attached")


def view_box(page):
    return page.get_attribute("#picture", "viewBox")


def title(page):
    return page.inner_text("#selected .title b")


def middle(page, key):
    box = page.locator(f'#picture .box[data-key="{key}"] rect').bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.slow
def test_mismatches_are_red_and_have_a_reason(page):
    assert page.locator("#picture .arrow[data-bad]").count() == 2
    assert page.locator("#picture .policy").all_text_contents() == ["reliability"]
    reason = "/scan: /slam receives nothing from /lidar: it requests RELIABLE, but the publisher"
    assert page.inner_text("#problem-list li").startswith(reason)
    assert "1 mismatch" in page.get_attribute("#picture", "aria-label")
    page.click("#problem-list button")
    assert title(page) == "/scan"
    assert page.inner_text("#selected .bad").startswith(reason)


def test_a_selected_topic_shows_types_qos_rate_and_its_last_message(page, robot):
    page.mouse.click(*middle(page, "topic /chatter"))
    assert title(page) == "/chatter"
    assert page.inner_text("#selected .types") == "std_msgs/msg/String"
    assert "best effort" not in page.inner_text("#selected")
    assert "reliable · volatile · depth 10" in page.inner_text("#selected")
    message = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello <b>"))
    for _ in range(10_000):  # a reading comes each second, and best effort may lose messages
        robot.talker.publish(message)
        if page.locator("#selected dd:has-text('Hz')").count():
            break
    page.wait_for_selector("#selected pre:has-text('data: \"hello <b>\"')")
    page.wait_for_selector("#picture .rate:has-text('Hz')", state="attached")
    page.keyboard.press("Escape")
    assert robot.wait_for(lambda: len(robot.subscribers("/chatter")) == 1)
    assert page.is_hidden("#selected")


def test_a_rate_can_be_kept_while_something_else_is_selected(page, robot):
    page.mouse.click(*middle(page, "topic /chatter"))
    page.click("#pin")
    assert page.get_attribute("#pin", "aria-pressed") == "true"
    page.mouse.click(*middle(page, "node /lidar"))
    assert title(page) == "/lidar"
    assert robot.wait_for(lambda: len(robot.subscribers("/chatter")) == 2)
    page.mouse.click(*middle(page, "topic /chatter"))
    page.click("#pin")
    page.keyboard.press("Escape")
    assert robot.wait_for(lambda: len(robot.subscribers("/chatter")) == 1)


def test_a_selected_node_shows_its_topics_which_can_be_followed(page):
    page.mouse.click(*middle(page, "node /slam"))
    assert title(page) == "/slam"
    near = page.locator("#picture .box[data-near]")
    assert sorted(each.get_attribute("data-key") for each in near.all()) == [
        "node /slam", "topic /scan",
    ]  # fmt: skip
    page.click("#selected .link:has-text('/scan')")
    assert title(page) == "/scan"
    page.click("#selected .link:has-text('/lidar')")
    assert title(page) == "/lidar"


def test_the_page_follows_the_graph(page, robot):
    page.mouse.click(*middle(page, "node /listener"))
    robot.node("newcomer")
    page.wait_for_selector('#picture [data-key="node /newcomer"]', state="attached")
    assert title(page) == "/listener"
    robot.node("listener").close()
    page.wait_for_selector("#selected:has-text('This node is gone.')")


def test_switches_choose_what_is_shown(page):
    page.select_option("#topics", "none")
    page.wait_for_selector('#picture [data-key="topic /scan"].box', state="detached")
    assert page.locator("#picture .arrow[data-bad]").count() == 1
    page.select_option("#topics", "all")
    page.fill("#words", "scan")
    page.wait_for_selector('#picture [data-key="node /talker"]', state="detached")
    assert "hidden" in page.inner_text("#counts")
    page.fill("#words", "no_such_name")
    page.wait_for_selector("#nothing:visible")
    page.fill("#words", "")
    wait_for_robot(page)


@pytest.mark.slow
def test_the_list_is_searched_and_walked_with_keys(page):
    page.keyboard.press("/")
    page.keyboard.type("LIS")
    assert page.locator("#list li").all_inner_texts() == ["/listener"]
    page.keyboard.press("Enter")
    assert title(page) == "/listener"
    page.fill("#search", "")
    page.focus("#list")
    page.keyboard.press("Home")
    page.keyboard.press("ArrowDown")
    active = page.get_attribute("#list", "aria-activedescendant")
    assert page.inner_text(f"#{active}") == "/listener"
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    assert title(page) == "/scan"
    row = page.get_by_role("option", name="topic /scan, mismatch")
    assert row.get_attribute("aria-selected") == "true"


@pytest.mark.slow
def test_a_row_far_down_the_list_is_pressed(robot, open_graph):
    for number in range(40):
        robot.node(f"node_{number}")
    page = open_graph()
    wait_for_robot(page)
    row = page.get_by_role("option", name="topic /scan, mismatch")
    row.scroll_into_view_if_needed()
    row.click()
    assert title(page) == "/scan"


def test_keys_move_the_picture(page):
    whole = view_box(page)
    page.focus("#picture")
    for key in ("ArrowRight", "ArrowDown", "+", "-"):
        before = view_box(page)
        page.keyboard.press(key)
        assert view_box(page) != before, key
    page.keyboard.press("Home")
    assert view_box(page) == whole


@pytest.mark.slow
def test_pointers_move_the_picture_and_select_nothing_then(page):
    whole = view_box(page)
    x, y = middle(page, "node /slam")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 80, y + 30, steps=4)
    page.mouse.up()
    moved = view_box(page)
    assert moved != whole
    assert page.is_hidden("#selected")
    page.mouse.wheel(0, -300)
    zoomed = "(box) => document.querySelector('#picture').getAttribute('viewBox') !== box"
    assert wait_until(page, f"async {zoomed}", moved)
    page.click("#fit")
    assert view_box(page) == whole
    page.mouse.click(*middle(page, "node /slam"))
    assert title(page) == "/slam"


def test_letters_are_no_shortcuts_when_they_are_switched_off(page):
    page.uncheck("#letter-keys")
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("/")
    assert page.evaluate("document.activeElement.id") != "search"


def test_a_lost_connection_is_said(page, graph_page):
    graph_page.close()
    page.wait_for_selector(LOST)


@pytest.mark.parametrize("scheme", only_first_is_fast("light", "dark"))
def test_texts_borders_and_rings_stand_out(robot, open_graph, scheme):
    page = open_graph(color_scheme=scheme)
    wait_for_robot(page)
    assert weak_rings(page) == {}
    page.mouse.click(*middle(page, "topic /scan"))
    assert weak_texts(page) == []
    assert weak_borders(page) == {}
    assert page.evaluate(UNREAD_NAMES) == []


@pytest.mark.parametrize("size", only_first_is_fast(*SIZES))
def test_the_page_fits_every_window(robot, open_graph, size):
    page = open_graph(size)
    wait_for_robot(page)
    page.focus("#list")
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    assert title(page) == "/scan"
    assert page.evaluate("document.documentElement.scrollWidth") <= SIZES[size][0]
    assert small_texts(page) == []
    picture = page.locator("#picture").bounding_box()
    assert picture["height"] > 120
    x, y = middle(page, "topic /scan")
    assert picture["x"] < x < picture["x"] + picture["width"]
    assert picture["y"] < y < picture["y"] + picture["height"]


@pytest.mark.slow
def test_the_size_of_texts_in_the_browser_counts(page):
    assert root_size_with(page, 24) == pytest.approx(22.5)


@pytest.mark.slow
def test_300_nodes_are_drawn_and_found(nodes, open_graph):
    picture = large(300).picture()
    for end in picture.endpoints:
        make = nodes.publisher if end.info.kind == "publisher" else nodes.subscription
        make(end.node.replace("/", "_")[1:], end.info.topic)
    page = open_graph()
    drawn = "async () => document.querySelectorAll('#picture .box').length === 902"
    assert wait_until(page, drawn)
    page.fill("#search", "robot7_node_157")
    page.keyboard.press("Enter")
    assert title(page) == "/robot7_node_157"
    x, y = middle(page, "node /robot7_node_157")
    found = "([x, y]) => document.elementFromPoint(x, y).closest('[data-key]')?.dataset.key"
    assert page.evaluate(found, [x, y]) == "node /robot7_node_157"
