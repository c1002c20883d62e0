"""The lines of the pens, as browsers get them: complete, in order, and bounded."""

from __future__ import annotations

import itertools
import math
import struct

from hypothesis import given
from hypothesis import strategies as st

from turtlesim import drawing
from turtlesim.drawing import RECORD_SIZE, StrokeHistory
from turtlesim.model import DEFAULT_PEN, Pen, Stroke


def records(data: bytes) -> list[tuple]:
    assert len(data) % RECORD_SIZE == 0
    return list(struct.iter_unpack("<I4f", data))


def walk(points: list[tuple[float, float]], pen: Pen = DEFAULT_PEN) -> list[Stroke]:
    return [Stroke(*a, *b, pen) for a, b in itertools.pairwise(points)]


def test_a_new_reader_gets_everything_and_an_old_one_the_rest():
    board = StrokeHistory()
    for stroke in walk([(0, 0), (1, 0), (2, 0)]):
        board.add("turtle1", stroke)
    restart, data, position = board.since(-1)
    assert restart
    assert records(data) == [(0xB3B8FF03, 0, 0, 1, 0), (0xB3B8FF03, 1, 0, 2, 0)]
    assert board.since(position) == (False, b"", position)
    board.add("turtle1", Stroke(2, 0, 3, 0, Pen(1, 2, 255, 10)))
    restart, data, position = board.since(position)
    assert not restart
    assert records(data) == [(0x0102FF0A, 2, 0, 3, 0)]


def test_clear_makes_every_reader_start_again():
    board = StrokeHistory()
    board.add("turtle1", Stroke(0, 0, 1, 0, DEFAULT_PEN))
    _, _, position = board.since(-1)
    board.clear()
    restart, data, position = board.since(position)
    assert (restart, data) == (True, b"")
    board.add("turtle1", Stroke(5, 5, 6, 5, DEFAULT_PEN))
    restart, data, _ = board.since(position)
    assert not restart
    assert len(records(data)) == 1


def test_a_reader_that_fell_back_too_far_starts_again(monkeypatch):
    monkeypatch.setattr(drawing, "_RECENT", 10)
    board = StrokeHistory()
    for stroke in walk([(k, 0) for k in range(6)]):
        board.add("turtle1", stroke)
    _, _, position = board.since(-1)
    for stroke in walk([(k, 0) for k in range(5, 30)]):
        board.add("turtle1", stroke)
    restart, data, _ = board.since(position)
    assert restart
    lines = records(data)
    assert lines[0][1:] == (0, 0, 19, 0)  # the old ones are one line by now
    assert len(lines) == 1 + 10
    assert lines[-1][1:] == (28, 0, 29, 0)


def test_pens_turtles_and_jumps_are_never_joined(monkeypatch):
    monkeypatch.setattr(drawing, "_RECENT", 0)
    board = StrokeHistory()
    red = Pen(255, 0, 0, 3)
    board.add("a", Stroke(0, 0, 1, 0, DEFAULT_PEN))
    board.add("b", Stroke(0, 5, 1, 5, DEFAULT_PEN))
    board.add("a", Stroke(1, 0, 2, 0, DEFAULT_PEN))  # joins
    board.add("a", Stroke(2, 0, 3, 0, red))
    board.add("a", Stroke(9, 0, 10, 0, red))
    board.add("a", Stroke(10, 0, 9.5, 0, red))  # back
    _, data, _ = board.since(-1)
    assert [line[1:] for line in records(data)] == [
        (0, 0, 2, 0),
        (0, 5, 1, 5),
        (2, 0, 3, 0),
        (9, 0, 10, 0),
        (10, 0, 9.5, 0),
    ]


def test_older_lines_are_bounded(monkeypatch):
    monkeypatch.setattr(drawing, "_RECENT", 3)
    monkeypatch.setattr(drawing, "_OLDER", 5)
    board = StrokeHistory()
    for k in range(100):
        board.add("a", Stroke(k, 0, k, 5, DEFAULT_PEN))
    _, data, _ = board.since(-1)
    assert [line[1] for line in records(data)] == list(range(92, 100))


@given(st.lists(st.tuples(st.floats(0.2, 4), st.floats(-0.6, 0.6)), min_size=2, max_size=60))
def test_joined_lines_stay_close_to_every_point(steps):
    """A random walk, all of it joined.

    Each visited point is within the tolerance of the line that stands for it.
    """
    points = [(250.0, 250.0)]
    heading = 0.0
    for length, turn in steps:
        heading += turn
        points.append(
            (points[-1][0] + length * math.cos(heading), points[-1][1] + length * math.sin(heading))
        )
    line = None
    visited = [points[0]]
    for stroke in walk(points):
        if line is None or not line.extend(stroke):
            line = drawing._Line(stroke)
            visited = [(stroke.x0, stroke.y0)]
        visited.append((stroke.x1, stroke.y1))
        _, x0, y0, x1, y1 = struct.unpack("<I4f", line.record())
        for x, y in visited:
            away = abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / math.hypot(x1 - x0, y1 - y0)
            assert away <= 0.05 + 1e-3


def test_an_arc_becomes_few_lines():
    points = [(250 + 60 * math.cos(k * 0.02), 250 + 60 * math.sin(k * 0.02)) for k in range(315)]
    line, lines = None, 0
    for stroke in walk(points):
        if line is None or not line.extend(stroke):
            line = drawing._Line(stroke)
            lines += 1
    assert (
        lines == 79
    )  # a chord of 4.9 pixels leaves the arc by the tolerance: 4 strokes of 1.2 pixels each
