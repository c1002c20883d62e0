"""The page in a real browser, on sliders without ROS."""

from __future__ import annotations

import math

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from joint_state_publisher.joints import JointSet
from joint_state_publisher_gui.page_commands import READER, Center, Play, Randomize, Set
from turtlewire.web.commands import CommandError


def row(page, name: str):
    return page.locator(f'.joint[data-name="{name}"]')


def value(page, name: str):
    return row(page, name).locator(".value input")


def wait_for_value(page, name: str, text: str) -> None:
    page.wait_for_function(
        "([name, text]) =>"
        " document.querySelector(`.joint[data-name='${name}'] .value input`)?.value === text",
        arg=[name, text],
    )


def test_all_joints_are_shown_with_their_limits_and_formulas(gui, page):
    wait_for_value(page, "lift", "0.300")
    assert page.locator(".joint").count() == 5
    assert page.title() == "crane · Joint State Publisher"
    assert page.locator("#node").inner_text() == "/joint_state_publisher"
    assert (
        row(page, "elbow").locator("small").inner_text()
        == "revolute, -1.000 to 2.000 rad, at most 2.500 rad/s"
    )
    assert row(page, "swivel").locator("small").inner_text() == "continuous"
    assert row(page, "wrist").locator("small").inner_text() == "= -0.5 · elbow + 0.25"
    assert row(page, "twin").locator("small").inner_text() == "= swivel"
    assert value(page, "wrist").is_disabled()
    assert value(page, "wrist").input_value() == "0.250"
    assert row(page, "swivel").locator("svg[role=slider]").count() == 1
    assert row(page, "twin").locator("svg[role=img]").count() == 1


def test_a_slider_moves_its_joint_and_those_that_follow(gui, page):
    row(page, "elbow").locator("input[type=range]").fill("10000")
    assert gui.next_command() == Set("elbow", 2.0)
    wait_for_value(page, "wrist", "-0.750")
    assert gui.joints.free["elbow"].position == 2.0


def test_a_value_is_typed_in_the_unit_that_is_shown(gui, page):
    page.get_by_role("button", name="Degrees").click()
    wait_for_value(page, "wrist", "14.3")
    assert row(page, "wrist").locator("small").inner_text() == "= -0.5 · elbow + 14.3239"
    value(page, "elbow").fill("90")
    value(page, "elbow").press("Enter")
    assert gui.next_command() == Set("elbow", pytest.approx(math.pi / 2))
    value(page, "lift").fill("9")  # metres stay metres; the limit holds
    value(page, "lift").press("Enter")
    assert gui.next_command() == Set("lift", 0.5)
    wait_for_value(page, "lift", "0.500")


def test_an_angle_of_more_than_half_a_turn_is_typed_for_an_endless_joint(gui, page):
    page.get_by_role("button", name="Degrees").click()
    value(page, "swivel").fill("270")
    value(page, "swivel").press("Enter")
    assert gui.next_command() == Set("swivel", pytest.approx(-math.pi / 2))
    wait_for_value(page, "swivel", "-90.0")


def test_nonsense_in_a_field_changes_nothing(gui, page):
    value(page, "elbow").fill("")
    value(page, "elbow").press("Enter")
    page.get_by_role("button", name="Center").click()
    assert gui.next_command() == Center()
    wait_for_value(page, "elbow", "0.000")


def test_keys_and_a_double_click(gui, page):
    slider = row(page, "elbow").locator("input[type=range]")
    slider.focus()
    page.keyboard.press("+")
    assert gui.next_command() == Set("elbow", pytest.approx(0.03))
    page.keyboard.press("-")
    assert gui.next_command() == Set("elbow", pytest.approx(0.0))
    row(page, "swivel").locator("svg").focus()
    page.keyboard.press("ArrowUp")
    assert gui.next_command() == Set("swivel", pytest.approx(0.02 * math.pi))
    row(page, "swivel").locator("svg").dblclick()
    while (command := gui.next_command()) != Set("swivel", 0.0):
        assert command.joint == "swivel"


def test_a_dial_is_turned_beyond_half_a_turn(gui, page):
    box = row(page, "swivel").locator("svg").bounding_box()
    x, y, r = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2, 0.3 * box["width"]
    page.mouse.move(x + r, y)
    page.mouse.down()
    for degrees in range(10, 211, 10):
        angle = math.radians(degrees)
        page.mouse.move(x + r * math.cos(angle), y - r * math.sin(angle))
    page.mouse.up()
    expected = math.radians(210 - 360)
    page.wait_for_function(
        "at => Math.abs("
        "document.querySelector('.joint[data-name=twin] .value input').value - at) < 0.05",
        arg=expected,
    )
    assert gui.joints.free["swivel"].position == pytest.approx(expected, abs=0.05)


def test_randomize_play_and_pause(gui, page):
    page.get_by_role("button", name="Randomize").click()
    assert gui.next_command() == Randomize()
    page.get_by_role("button", name="Play").click()
    assert gui.next_command() == Play(True)
    page.wait_for_selector("#play[aria-pressed=true]")
    before = gui.sliders.snapshot().positions
    gui.sliders.advance(0.1)
    assert all(a != b for a, b in zip(before, gui.sliders.snapshot().positions, strict=True))
    value(page, "elbow").fill("1")
    value(page, "elbow").press("Enter")
    assert gui.next_command() == Play(False)
    assert gui.next_command() == Set("elbow", 1.0)
    page.wait_for_selector("#play[aria-pressed=false]")


def test_search(gui, page):
    page.keyboard.press("/")
    page.keyboard.type("W i")
    page.get_by_text("3 of 5 joints").wait_for()  # the joints may come after the page is live
    assert page.locator(".joint:visible").count() == 3


def test_a_slash_searches_after_a_slider_was_used(gui, page):
    row(page, "elbow").locator("input[type=range]").focus()
    page.keyboard.type("/elb")
    assert page.locator("#search").input_value() == "elb"


def test_a_robot_without_joints_is_not_waited_for(gui, page):
    row(page, "elbow").wait_for()
    gui.sliders.show(JointSet("rock"))
    gui.screen.update()
    page.get_by_text("The robot rock has no joints to move.").wait_for()
    assert page.locator("#empty:visible").count() == 0
    for name in ("Randomize", "Center", "Play"):
        assert page.get_by_role("button", name=name).is_disabled()
    gui.sliders.show(gui.joints)
    gui.screen.update()
    page.wait_for_selector("#rigid", state="hidden")
    assert page.get_by_role("button", name="Play").is_enabled()


def test_another_robot_replaces_the_joints(gui, page):
    row(page, "elbow").wait_for()
    gui.sliders.show(JointSet())
    gui.screen.update()
    page.wait_for_selector("#empty:visible")
    assert page.locator(".joint").count() == 0


def test_a_mimic_joint_has_the_unit_of_its_own_type(gui, open_page):
    gui.joints.kinds["wrist"] = "prismatic"  # driven by a revolute joint
    page = open_page(gui.screen.url)
    assert row(page, "wrist").locator(".value").inner_text() == "m"
    page.get_by_role("button", name="Degrees").click()
    wait_for_value(page, "elbow", "0.0")
    assert value(page, "wrist").input_value() == "0.250"


def test_names_are_text_not_markup(gui, open_page):
    gui.joints.order.append("<img src=x onerror=alert(1)>")
    gui.joints.mimics["<img src=x onerror=alert(1)>"] = gui.joints.mimics["twin"]
    gui.joints.kinds["<img src=x onerror=alert(1)>"] = "continuous"
    page = open_page(gui.screen.url)
    page.get_by_text("<img src=x onerror=alert(1)>").wait_for()
    assert page.locator(".joint img").count() == 0


def test_an_error_is_shown(gui, page):
    with connect(gui.screen.url.replace("http", "ws") + "live") as socket:
        socket.send('{"type": "set", "joint": "elbow", "position": "far"}')
        texts = [socket.recv(timeout=60) for _ in range(3)]
    assert any("position must be a number from" in text for text in texts)
    assert page.locator("#message:visible").count() == 0  # only its sender gets the error


def test_foreign_pages_are_refused(gui):
    url = gui.screen.url.replace("http", "ws") + "live"
    with pytest.raises(InvalidStatus, match="403"):
        connect(url, origin="http://evil.example")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1200, 800), (360, 740)])
def test_everything_fits_on_desktop_and_phone(gui, open_page, scheme, size):
    page = open_page(
        gui.screen.url, viewport={"width": size[0], "height": size[1]}, color_scheme=scheme
    )
    row(page, "twin").wait_for()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    lightness = page.evaluate(
        "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).reduce((a, b) => a + +b, 0)"
    )
    assert (lightness < 200) == (scheme == "dark")


# The commands of a page.


@pytest.mark.parametrize(
    ("text", "command"),
    [
        ('{"type": "set", "joint": "a", "position": 1}', Set("a", 1.0)),
        ('{"type": "randomize"}', Randomize()),
        ('{"type": "center"}', Center()),
        ('{"type": "play", "on": true}', Play(True)),
    ],
)
def test_commands(text, command):
    assert READER.read(text) == command


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("[]", "expected an object whose type is one of set, randomize, center, play"),
        ('{"type": "set", "joint": "a", "position": NaN}', "position must be a number from"),
        ('{"type": "play", "on": 1}', "on must be true or false"),
    ],
)
def test_unknown_page_commands(text, error):
    with pytest.raises(CommandError, match=error):
        READER.read(text)
