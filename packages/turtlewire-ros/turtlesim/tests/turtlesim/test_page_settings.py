"""Pen, background and pace, set in the page and shown as they are; and what the simulator does."""

from __future__ import annotations

import math

import pytest

from turtlesim import page_commands
from turtlesim.drawing import look_of, shown_pen
from turtlesim.model import DEFAULT_PEN, TICK_NS, Pen, World
from turtlesim.pace import Pace, hold

from .seen import wait_for_pixel, wait_for_text, wait_until


def set_colour(page, selector: str, css: str) -> None:
    """Choose a colour, as the browser's dialogue does."""
    page.eval_on_selector(
        selector,
        "(input, css) => { input.value = css; input.dispatchEvent(new Event('change')); }",
        css,
    )


def is_colour(*wanted: int, within: float = 45.0):
    return lambda colour: math.dist(colour[:3], wanted) < within


def test_the_pen_of_the_driven_turtle(simulator, page):
    assert page.input_value("#pen-colour") == "#72c3b0"
    assert page.input_value("#pen-width") == "3"
    set_colour(page, "#pen-colour", "#ff8800")
    page.focus("#pen-width")
    for _ in range(7):
        page.keyboard.press("ArrowRight")  # moves the slider, and drives nobody
    wait_until(lambda: simulator.turtle1.pen == Pen(255, 136, 0, 10))
    middle = simulator.turtle1.x
    page.get_by_role("button", name="forward").press("Enter")
    wait_until(lambda: simulator.turtle1.x > middle + 1.5)
    assert simulator.turtle1.pen == Pen(255, 136, 0, 10)
    for y in (middle, middle + 0.06):  # ten pixels of the image are 0.22 m wide
        wait_for_pixel(page, "ground", middle + 1.0, y, is_colour(255, 136, 0, within=12))
    page.click("#pen-up")
    wait_until(lambda: not simulator.turtle1.pen_on)
    page.wait_for_selector("#pen-up[aria-pressed=true]")
    page.click("#pen-up")
    wait_until(lambda: simulator.turtle1.pen_on)
    assert simulator.turtle1.pen == Pen(255, 136, 0, 10)
    kinds = {type(command) for command in simulator.commands}
    assert kinds == {page_commands.PenChange, page_commands.Drive}


def test_a_pen_that_a_node_sets_is_shown(simulator, page):
    simulator.turtle1.set_pen(Pen(1, 2, 3, 7), off=False)
    simulator.turtle1.set_pen(Pen(0, 0, 0, 0), off=True)  # lifted, it keeps its colour
    page.wait_for_selector("#pen-up[aria-pressed=true]")
    assert page.input_value("#pen-colour") == "#010203"
    assert page.input_value("#pen-width") == "7"
    simulator.world.spawn(4.0, 2.0, 0.0, "turtle2")
    page.get_by_role("button", name="turtle2").click()  # its pen is another one
    page.wait_for_selector("#pen-up[aria-pressed=false]")
    assert page.input_value("#pen-colour") == "#ecb296"


def test_the_background(simulator, page):
    assert page.input_value("#background") == "#4556ff"
    set_colour(page, "#background", "#226644")
    wait_for_pixel(page, "ground", 2.5, 2.5, is_colour(0x22, 0x66, 0x44))
    assert simulator.commands == [page_commands.Background(0x22, 0x66, 0x44)]
    simulator.background = (9, 8, 7)
    page.wait_for_function("() => document.getElementById('background').value === '#090807'")


def test_pause_and_speed(simulator, page):
    page.select_option("#speed", "2")
    wait_for_text(page, "#connection", "live, 2 ")
    page.click("#pause")
    wait_for_text(page, "#connection", "paused")
    page.wait_for_selector("#connection[data-paused]")
    page.get_by_role("button", name="Go on").click()
    wait_for_text(page, "#connection", "live, 2 ")
    assert [command.factor for command in simulator.commands] == [2.0, 0.0, 2.0]
    simulator.speed = 20.0  # by a node
    wait_for_text(page, "#connection", "live, 20 ")
    assert page.input_value("#speed") == "20"


def test_lines_have_the_colour_of_their_turtles_shell(simulator, open_page):
    simulator.world.spawn(4.0, 2.0, 0.0, "turtle2")
    page = open_page(simulator.screen.url)
    simulator.turtle1.drive(2.0, 0.0, 0.0)
    simulator.world.turtles["turtle2"].drive(2.0, 0.0, 0.0)
    wait_for_pixel(page, "ground", 6.5, simulator.turtle1.x, is_colour(0x72, 0xC3, 0xB0, within=12))
    wait_for_pixel(page, "ground", 5.0, 2.0, is_colour(0xEC, 0xB2, 0x96, within=12))


def test_only_the_pen_that_nobody_set_is_tinted():
    assert shown_pen("turtle2", DEFAULT_PEN) == Pen(0xEC, 0xB2, 0x96, 3)
    assert shown_pen("turtle2", Pen(1, 2, 3, 4)) == Pen(1, 2, 3, 4)


def test_page_and_simulator_agree_on_the_looks(simulator, open_page):
    names = ["turtle1", "turtle8", "turtle9", "turtle10", "turtle0", "Fritz", "a_b", "7", "", "Zoé"]
    names += ["turtle007", "turtle12345678901234567890", "x" * 200]
    page = open_page(simulator.screen.url)
    code = """async (names) => {
        const { lookOf } = await import('/js/looks.js');
        const looks = Array.from({ length: 8 }, (_, k) => lookOf(`turtle${k + 1}`));
        return names.map((name) => looks.indexOf(lookOf(name)));
    }"""
    assert page.evaluate(code, names) == [look_of(name) for name in names]


# What the simulator does


def test_simulated_time_goes_on_from_where_it_was():
    pace = Pace()
    assert pace.tick(10**15) == 10**15  # the clock's
    pace.change(0.5, 10**15 + 1000)
    assert pace.tick(10**15 + 99_000) == 10**15 + 1000 + TICK_NS
    assert pace.period_ns == 2 * TICK_NS
    pace.change(0.0, 10**15 + 100_000)
    assert pace.period_ns > 0
    pace.change(1.0, 2 * 10**15)
    assert pace.tick(2 * 10**15 + 7) == 10**15 + 1000 + TICK_NS + 7
    pace.change(4.0, 2 * 10**15 + 10)
    assert pace.period_ns == TICK_NS / 4


def test_a_held_turtle_moves_by_teleport_only():
    world = World()
    turtle = world.spawn_centred()
    turtle.drive(2.0, 0.0, 1.0)
    (still,) = hold(world.in_order())
    assert (still.pose.x, still.move_stroke, still.teleport_strokes) == (turtle.x, None, [])
    turtle.teleport_absolute(2.0, 3.0, 0.5)
    (moved,) = hold(world.in_order())
    assert (moved.pose.x, moved.pose.y) == (2.0, pytest.approx(3.0))
    assert len(moved.teleport_strokes) == 1
    (tick,) = world.step(TICK_NS)  # the command is as new as it was
    assert tick.pose.linear_velocity == 2.0
    assert not tick.teleport_strokes
