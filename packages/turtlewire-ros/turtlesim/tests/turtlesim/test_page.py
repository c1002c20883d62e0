"""The page in a real browser, on the model and its screen (no ROS; `test_turtlesim_node.py` has the
way through ROS).
"""

import json
import math
import time

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from turtlesim.page_commands import (
    READER,
    Background,
    Cancel,
    Clear,
    Drive,
    Kill,
    PenChange,
    Reset,
    Rotate,
    Spawn,
    Speed,
    Teleport,
    Unwatch,
    Watch,
)
from turtlewire.web.commands import CommandError

from .seen import (
    is_at_rest,
    is_ground,
    is_opaque,
    is_pen,
    on_screen,
    pixel,
    publish_transform,
    wait_for_pixel,
    wait_for_text,
    wait_until,
)


def test_the_turtle_is_shown_where_it_is(simulator, page):
    middle = simulator.turtle1.x
    wait_for_text(page, "#roster", "turtle1")
    wait_for_text(page, "#roster", "5.54")
    assert wait_for_pixel(page, "turtles", middle, middle, is_opaque)  # the shell
    assert pixel(page, "turtles", 2.0, 2.0)[3] == 0
    assert is_ground(pixel(page, "ground", 2.5, 2.5))
    assert page.title() == "turtlesim /sim"


@pytest.mark.slow
def test_another_device_is_served_below_the_token(make_simulator, open_page):
    simulator = make_simulator(lan=True)
    middle = simulator.turtle1.x
    page = open_page(simulator.screen.url)
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", middle + 2.0, middle, is_opaque)
    assert simulator.commands


def test_an_arrow_key_is_one_command_and_the_pen_draws(simulator, page):
    middle = simulator.turtle1.x
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", middle + 2.0, middle, is_opaque)
    assert simulator.commands == [Drive("turtle1", 2.0, 0.0)]
    assert is_pen(wait_for_pixel(page, "ground", middle + 1.0, middle, is_pen))
    for key in ("ArrowLeft", "ArrowRight", "Control+ArrowUp", "ArrowDown"):
        page.keyboard.press(key)
    wait_until(lambda: len(simulator.commands) == 4 and is_at_rest(simulator.turtle1))
    page.click("#clear")  # from here on nothing is drawn
    wait_for_pixel(page, "ground", middle + 1.0, middle, is_ground)
    drives = [Drive("turtle1", *drive) for drive in ((0.0, 2.0), (0.0, -2.0), (-2.0, 0.0))]
    assert simulator.commands[1:] == [*drives, Clear()]


def test_the_pad_drives_by_mouse_touch_and_keyboard(simulator, open_page):
    page = open_page(simulator.screen.url, has_touch=True)
    page.evaluate("window.setInterval = () => 0")  # a long press would be more than one command
    forward = page.get_by_role("button", name="forward")
    forward.click()
    forward.tap()
    forward.focus()
    page.keyboard.press("Enter")
    page.click("#clear")
    wait_until(lambda: Clear() in simulator.commands)
    assert simulator.commands[:-1] == 3 * [Drive("turtle1", 2.0, 0.0)]


def test_a_button_that_is_held_repeats_its_command(simulator, page):
    page.get_by_role("button", name="turn left").hover()
    page.mouse.down()
    wait_until(lambda: len(simulator.commands) > 3)
    page.mouse.up()
    assert {*simulator.commands} == {Drive("turtle1", 0.0, 2.0)}


@pytest.mark.slow
def test_keys_and_buttons_turn_to_a_heading(simulator, page):
    headings = {
        "g": 0.0,
        "t": 0.7854,
        "r": 1.5708,
        "e": 2.3562,
        "d": 3.1416,
        "c": -2.3562,
        "v": -1.5708,
        "b": -0.7854,
    }  # as in teleop
    for key in [*headings, "f", "F", "q", "Alt+t"]:
        page.keyboard.press(key)
    page.get_by_role("button", name="turn to 90°").click()
    page.get_by_role("button", name="cancel the rotation").click()
    wait_until(lambda: len(simulator.commands) == 12)
    turns = [Rotate("turtle1", theta) for theta in headings.values()]
    cancel = Cancel("turtle1")
    assert simulator.commands == [
        *turns,
        cancel,
        cancel,
        Rotate("turtle1", 1.5708),
        cancel,
    ]
    wait_for_text(
        page, "#roster", "89°"
    )  # a rotation ends 0.02 rad before its goal, as in the original
    page.focus("#clear")
    page.keyboard.press("g")  # wherever the focus is
    wait_until(lambda: len(simulator.commands) == 13)


def test_another_turtle_can_be_chosen(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url)
    wait_for_text(page, "#words", "turtle1 is 1.54 m ahead and 3.54 m to the left of turtle2")
    page.get_by_role("button", name="turtle2").click()
    assert page.inner_text("#driven") == "turtle2"
    page.keyboard.press("ArrowUp")
    wait_for_pixel(page, "turtles", 6.0, 2.0, is_opaque)
    assert simulator.commands == [Drive("turtle2", 2.0, 0.0)]
    wait_for_text(page, "#words", "of turtle1")


def test_a_crowd_moves_and_draws(simulator, page):
    """More than a hundred come as arrays, and are drawn turned beforehand."""
    for k in range(150):
        place = 2.0 + 0.02 * k
        simulator._queue.put(Spawn(place, place, 0.0, f"member{k}"))
    wait_for_text(page, "#more", "and 91 more")
    wait_for_pixel(page, "turtles", 2.0, 2.0, is_opaque)
    assert pixel(page, "turtles", 4.0, 2.0)[3] == 0
    for k in range(150):
        simulator._queue.put(Drive(f"member{k}", 2.0, 0.0))
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    wait_for_pixel(page, "ground", 2.5, 2.0, lambda colour: not is_ground(colour))
    wait_for_pixel(page, "turtles", 2.0, 2.0, lambda colour: colour[3] == 0)  # its neighbours, too


@pytest.mark.slow
def test_two_browsers_show_the_same_world(simulator, open_page):
    one = open_page(simulator.screen.url)
    middle = simulator.turtle1.x
    one.keyboard.press("ArrowUp")
    wait_for_pixel(one, "ground", middle + 0.5, middle, is_pen)
    two = open_page(simulator.screen.url)
    wait_for_pixel(two, "ground", middle + 0.5, middle, is_pen)  # drawn before it came
    two.get_by_role("button", name="New turtle").press("Enter")  # by keyboard: somewhere
    for page in (one, two):
        wait_for_text(page, "#roster", "turtle2")
        wait_for_text(page, "#announcer", "turtle2 appeared")


def test_a_lost_simulator_is_said_and_found_again(simulator, make_simulator, open_page):
    page = open_page(simulator.screen.url)
    simulator.close()
    wait_for_text(page, "#connection", "connection lost, trying again")
    again = make_simulator(port=simulator.screen.url.split(":")[-1].strip("/"))
    again.turtle1.teleport_absolute(2.0, 3.0, 0.0)
    again.world.spawn(9.0, 9.0, 0.0, "newcomer")
    wait_for_text(page, "#connection", "live")
    wait_for_text(page, "#roster", "newcomer")
    wait_for_pixel(page, "turtles", 2.0, 3.0, is_opaque)


def test_a_missing_turtle_is_offered(simulator, page):
    assert not page.is_visible("#hint")
    simulator.missing = ("turtle2",)
    page.get_by_role("button", name="Spawn turtle2").click()
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    assert simulator.commands == [Spawn(4.0, 2.0, 0.0, "turtle2")]
    simulator.missing = ()
    page.wait_for_selector("#hint", state="hidden")


def test_a_turtle_is_chosen_and_dragged_on_the_field(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.5, "turtle2")
    page = open_page(simulator.screen.url)
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    page.mouse.click(*on_screen(page, 4.1, 2.1))
    assert page.inner_text("#driven") == "turtle2"
    page.mouse.move(*on_screen(page, 4.0, 2.0))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 6.0, 7.0))
    page.mouse.move(*on_screen(page, 8.0, 3.0))
    page.mouse.up()
    wait_until(lambda: simulator.commands)
    (command,) = simulator.commands
    assert command == Teleport(
        "turtle2", pytest.approx(8.0, abs=0.05), pytest.approx(3.0, abs=0.05), pytest.approx(0.5)
    )
    wait_for_pixel(page, "turtles", 8.0, 3.0, is_opaque)


def test_a_new_turtle_is_placed_on_the_field(simulator, page):
    page.click("#spawn")
    page.keyboard.press("Escape")
    page.mouse.click(*on_screen(page, 2.0, 2.0))  # nothing is being placed any more
    page.click("#spawn")
    assert page.is_visible("#placing")
    page.mouse.move(*on_screen(page, 2.0, 9.0))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 2.0, 8.0))
    page.mouse.up()
    wait_until(lambda: simulator.commands)
    near = pytest.approx
    assert simulator.commands == [
        Spawn(near(2.0, abs=0.05), near(9.0, abs=0.05), near(-math.pi / 2, abs=0.05), "")
    ]
    assert not page.is_visible("#placing")
    wait_for_pixel(page, "turtles", 2.0, 9.0, is_opaque)


def test_a_finger_chooses_and_places_turtles(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.5, "turtle2")
    page = open_page(
        simulator.screen.url, has_touch=True, is_mobile=True, viewport={"width": 360, "height": 740}
    )
    wait_for_pixel(page, "turtles", 4.0, 2.0, is_opaque)
    page.touchscreen.tap(*on_screen(page, 4.1, 2.1))
    assert page.inner_text("#driven") == "turtle2"
    page.tap("#compass button:first-child")
    page.tap("#spawn")
    page.locator("#turtles").scroll_into_view_if_needed()
    page.touchscreen.tap(*on_screen(page, 8.0, 8.0))
    wait_until(lambda: len(simulator.commands) == 2)
    near = pytest.approx
    assert simulator.commands == [
        Rotate("turtle2", 2.3562),
        Spawn(near(8.0, abs=0.1), near(8.0, abs=0.1), 0.0, ""),
    ]
    wait_for_pixel(page, "turtles", 8.0, 8.0, is_opaque)


def test_following_keeps_the_driven_turtle_in_the_middle(simulator, page):
    page.click("#follow")
    simulator.turtle1.teleport_absolute(3.0, 7.0, 0.0)
    middle = 499 / 90
    wait_for_pixel(page, "turtles", middle, middle, is_opaque)
    wait_for_text(page, "#roster", "7.00")
    ground = page.evaluate("() => document.getElementById('ground').getBoundingClientRect().width")
    assert ground == pytest.approx(2.5 * page.locator("#turtles").bounding_box()["width"], abs=2)
    page.click("#follow")
    wait_for_pixel(page, "turtles", 3.0, 7.0, is_opaque)
    assert pixel(page, "turtles", middle, middle)[3] == 0


def test_the_frames_are_shown_live_and_a_transform_in_plain_words(simulator, page):
    assert page.is_visible("#no-frames")
    now = time.time_ns()
    for age_s in (2.0, 1.0, 0.0):
        publish_transform(simulator, "world", "turtle1", now - int(age_s * 1e9), 1.0, 3.0)
        publish_transform(simulator, "world", "turtle2", now - int(age_s * 1e9), 4.0, 2.0)
    wait_for_text(page, "#tree", "turtle2")
    wait_for_text(
        page,
        "#relation-words",
        "turtle1 is 3.00 m behind and 1.00 m to the left of turtle2, and looks the same way",
    )
    assert page.inner_text("#tree > li > span") == "world"
    page.wait_for_selector("#tree li li[data-kind='stale'] small:has-text('s old')")
    publish_transform(simulator, "turtle1", "carrot", time.time_ns(), 0.0, 2.0)
    wait_for_text(page, "#tree li li li", "carrot")
    page.select_option("#source", "carrot")
    page.select_option("#target", "turtle1")
    wait_for_text(page, "#relation-words", "carrot is 2.00 m to the left of turtle1")
    page.focus("#source")
    page.keyboard.press("ArrowDown")  # chooses the next frame, and drives nobody
    page.keyboard.press("t")
    assert page.input_value("#source") in ("turtle1", "turtle2")
    assert simulator.commands == []
    publish_transform(simulator, "elsewhere", "lost", time.time_ns(), 0.0, 2.0)
    wait_for_text(page, "#tree", "lost")
    page.select_option("#source", "lost")
    wait_for_text(page, "#relation-words", "Tf has two or more unconnected trees.")
    page.click("#frames summary")
    page.click("#axes")
    wait_until(
        lambda: not any(node.name == "_turtlesim_page" for node in simulator.wire.graph.nodes())
    )


@pytest.mark.slow
def test_a_screen_reader_finds_its_way(simulator, page):
    page.get_by_role("status").get_by_text("live").wait_for()
    page.get_by_role("cell", name="5.54").first.wait_for()
    page.get_by_role("img", name="The field, 11 by 11 metres, with turtle1 at 5.5, 5.5").wait_for()
    for name in (
        "forward",
        "backward",
        "turn left",
        "turn right",
        "Clear drawing",
        "Reset",
        "New turtle",
    ):
        assert page.get_by_role("button", name=name).is_visible()


def test_a_foreign_page_is_refused(simulator, make_simulator, open_page):
    live = simulator.screen.url.replace("http", "ws") + "live"
    with pytest.raises(InvalidStatus) as refused, connect(live, origin="http://evil.example"):
        pass
    assert refused.value.response.status_code == 403
    stranger = make_simulator()  # another page of this machine: same host, other port
    page = open_page(stranger.screen.url)
    outcome = """url => new Promise((resolve) => {
        const socket = new WebSocket(url);
        socket.onopen = () => resolve('open');
        socket.onerror = () => resolve('refused');
    })"""
    assert page.evaluate(outcome, stranger.screen.url.replace("http", "ws") + "live") == "open"
    assert page.evaluate("fetch('/live').then((answer) => answer.status)") == 426
    assert page.evaluate(outcome, live) == "refused"


def test_invalid_page_messages_are_answered(simulator):
    with connect(simulator.screen.url.replace("http", "ws") + "live") as raw:
        assert json.loads(raw.recv(timeout=60))["turtles"] == ["turtle1"]
        raw.send('{"type": "drive", "turtle": "turtle1", "linear": "fast", "angular": 0}')
        texts = [message for _ in range(20) if isinstance(message := raw.recv(timeout=60), str)]
        assert [json.loads(text) for text in texts] == [
            {"type": "error", "text": "linear must be a number from -1000000 to 1000000"}
        ]
        raw.send("[" * 60_000)
        answers = (message for _ in range(100) if isinstance(message := raw.recv(timeout=60), str))
        answer = json.loads(next(answers))
        assert answer["type"] == "error"
        assert answer["text"] in {
            "not a command: the JSON is nested too deeply",
            # Python 3.14 reads as deeply as its stack is large.
            "not JSON: Expecting value: line 1 column 60001 (char 60000)",
        }
    assert simulator.commands == []


# The commands of pages.


@pytest.mark.parametrize(
    ("message", "command"),
    [
        (
            {"type": "drive", "turtle": "turtle1", "linear": 2, "angular": -0.5},
            Drive("turtle1", 2.0, -0.5),
        ),
        ({"type": "rotate", "turtle": "turtle1", "theta": 3.1416}, Rotate("turtle1", 3.1416)),
        ({"type": "cancel", "turtle": "turtle1"}, Cancel("turtle1")),
        ({"type": "spawn", "x": 1.5, "y": 2, "theta": 0, "name": ""}, Spawn(1.5, 2.0, 0.0, "")),
        (
            {"type": "teleport", "turtle": "t", "x": 1, "y": 2, "theta": 3},
            Teleport("t", 1.0, 2.0, 3.0),
        ),
        ({"type": "kill", "turtle": "t"}, Kill("t")),
        ({"type": "clear"}, Clear()),
        ({"type": "reset"}, Reset()),
        (
            {"type": "watch", "target": "turtle2", "source": "", "axes": True},
            Watch("turtle2", "", True),
        ),
        (
            {"type": "pen", "turtle": "t", "r": 255, "g": 0, "b": 7, "width": 3, "off": False},
            PenChange("t", 255, 0, 7, 3, False),
        ),
        ({"type": "background", "r": 1, "g": 2, "b": 3}, Background(1, 2, 3)),
        ({"type": "speed", "factor": 0.25}, Speed(0.25)),
        ({"type": "unwatch"}, Unwatch()),
    ],
)
def test_commands(message, command):
    parsed = READER.read(json.dumps(message))
    assert parsed == command
    assert type(parsed) is type(command)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        (
            "[1]",
            (
                "type is one of drive, rotate, cancel, spawn, teleport, kill, pen, background, "
                "speed, clear, reset, watch, unwatch"
            ),
        ),
        ('{"type": "background", "r": 256, "g": 0, "b": 0}', "r must be a whole number from 0 to"),
        ('{"type": "speed", "factor": -0.1}', "factor must be a number from 0 to 100"),
        ('{"type": "speed", "factor": 100.1}', "factor must be a number from 0 to 100"),
    ],
)
def test_invalid_commands(text, part):
    with pytest.raises(CommandError, match=part):
        READER.read(text)
