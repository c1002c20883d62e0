"""The path picture: strokes one by one, many at once, and at the edges."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.programs import run_python

from turtlesim.model import DEFAULT_PEN, Pen, Stroke
from turtlesim.path import EMPTY_COLOUR, PathImage
from turtlesim.path_bulk import as_arrays, draw_short_lines

halves = st.integers(-8, 1008).map(lambda k: k / 2)  # where edges meet the centres of pixels
positions = st.floats(-4.0, 504.0) | halves
short = st.floats(-3.0, 3.0) | st.sampled_from([0.0, 1.0, -2.5])
pens = st.builds(
    Pen, st.integers(0, 255), st.integers(0, 255), st.integers(0, 255), st.integers(1, 4)
)


@st.composite
def short_strokes(draw):
    x, y = draw(positions), draw(positions)
    return Stroke(x, y, x + draw(short), y + draw(short), draw(pens))


@given(st.lists(short_strokes(), min_size=1, max_size=30))
def test_many_at_once_are_the_same_pixels_as_one_by_one(strokes):
    one_by_one = PathImage()
    for stroke in strokes:
        one_by_one.draw(stroke)
    together = bytearray(PathImage().rgba())
    assert draw_short_lines(together, *as_arrays(strokes))
    assert bytes(together) == one_by_one.rgba()


@pytest.mark.parametrize("long", [False, True])
def test_lines_in_arrays_are_drawn_after_what_waits(long):
    strokes = [Stroke(100 + k, 100, 102 + k, 101, Pen(k, 0, 0, 3)) for k in range(10)]
    if long:
        strokes.append(Stroke(100, 90, 140, 120, Pen(9, 9, 9, 3)))
    one_by_one, mixed = PathImage(), PathImage()
    for stroke in strokes:
        one_by_one.draw(stroke)
    for stroke in strokes[:3]:
        mixed.draw(stroke)
    mixed.draw_lines(*as_arrays(strokes[3:]))
    assert mixed.rgba() == one_by_one.rgba()


def test_long_strokes_are_left_to_the_slow_way():
    picture = bytearray(PathImage().rgba())
    before = bytes(picture)
    assert not draw_short_lines(
        picture,
        *as_arrays([Stroke(10, 10, 12, 10, DEFAULT_PEN), Stroke(10, 10, 300, 10, DEFAULT_PEN)]),
    )
    assert bytes(picture) == before


@pytest.mark.parametrize("long", [False, True])
def test_a_swarm_is_drawn_in_order(long):
    path = PathImage()
    colours = [Pen(k % 256, k // 256, 7, 3) for k in range(600)]
    for pen in colours:
        path.draw(Stroke(100, 100, 102, 100, pen))
    if long:
        path.draw(Stroke(300, 100, 400, 100, DEFAULT_PEN))
    path.settle()
    assert path.colour_at(101, 100) == colours[-1][:3]
    assert path.colour_at(200, 100) == EMPTY_COLOUR


def test_a_line_of_no_length_is_a_dot_of_the_pen():
    path = PathImage()
    path.draw(Stroke(50.0, 60.0, 50.0, 60.0, Pen(1, 2, 3, 4)))
    painted = [(i % 500, i // 500) for i, alpha in enumerate(path.rgba()[3::4]) if alpha]
    assert (min(painted), max(painted), len(painted)) == ((48, 58), (51, 61), 16)


def painted(rgba: bytes) -> tuple[set[int], set[int]]:
    """Columns and rows with a painted pixel."""
    pixels = [(i % 500, i // 500) for i, alpha in enumerate(rgba[3::4]) if alpha]
    return {column for column, _ in pixels}, {row for _, row in pixels}


@pytest.mark.parametrize("together", [False, True])
def test_a_pen_of_width_six_draws_six_rows(together):
    """An even pen on the turtle's first row, 249.5: its edges meet the centres of pixels."""
    pen = Pen(1, 2, 3, 6)
    level, upright = (
        Stroke(249.5, 249.5, 251.5, 249.5, pen),
        Stroke(249.5, 249.5, 249.5, 252.5, pen),
    )
    for stroke, (columns, rows) in (
        (level, (range(247, 255), range(247, 253))),
        (upright, (range(247, 253), range(247, 256))),
    ):
        path, picture = PathImage(), bytearray(PathImage().rgba())
        path.draw(stroke)
        assert draw_short_lines(picture, *as_arrays([stroke]))
        assert painted(bytes(picture) if together else path.rgba()) == (set(columns), set(rows))


def test_parts_outside_are_clipped():
    path = PathImage()
    path.draw(Stroke(-100.0, -100.0, -90.0, -95.0, DEFAULT_PEN))
    path.draw(Stroke(-100.0, 250.0, 900.0, 250.0, DEFAULT_PEN))
    rows = {i // 500 for i, alpha in enumerate(path.rgba()[3::4]) if alpha}
    assert rows <= {248, 249, 250, 251}
    assert path.colour_at(0, 250) == path.colour_at(499, 250) == DEFAULT_PEN[:3]


def test_few_turtles_never_load_numpy():
    code = """
import sys
from turtlesim.model import World
from turtlesim.path import PathImage
world, path = World(), PathImage()
for _ in range(20):
    world.spawn_centred().drive(1.0, 0.0, 1.0)
for tick in range(60):
    for result in world.step(tick * 16_000_000):
        path.draw(result.move_stroke)
    path.settle()
path.colour_at(250, 250)
print("numpy" in sys.modules)
"""
    assert run_python(code).stdout == "False\n"
