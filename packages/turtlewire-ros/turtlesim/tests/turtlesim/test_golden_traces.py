"""The model and the path picture against traces of the real turtlesim.

Every bit of every pose, colour and feedback.
"""

from __future__ import annotations

import csv
import json
import struct

import pytest
from tests.places import GOLDEN

from tests import archive
from turtlesim.model import Pen, World
from turtlesim.path import PathImage

TRACED = archive.read(GOLDEN / "sim" / "traces.txt")
#: name -> number of ticks in the trace
TRACES = {
    "arc": 144,
    "holonomic_off_y_ignored": 119,
    "reverse": 144,
    "rotate_absolute": 584,
    "rotation": 143,
    "square": 670,
    "straight": 144,
    "teleport_absolute": 123,
    "wall": 326,
}
PICTURES = {"arc": 287, "rotation": 0, "square": 1094, "teleport_absolute": 4198}
#: A command shows from the first tick that was received this long after it was sent, or later [s].
SEND_TO_RECEIVE = 0.0005


def float32(value: float) -> float:
    return struct.unpack("<f", struct.pack("<f", value))[0]


def read_csv(trace: str, name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(TRACED[f"{trace}/{name}"].content.decode().splitlines()))


def read_json(trace: str, name: str) -> dict:
    return json.loads(TRACED[f"{trace}/{name}"].content)


class Replay:
    """One trace run through our model: what it published, and the picture that it drew."""

    def __init__(self, name: str) -> None:
        self.rows = read_csv(name, "poses.csv")
        self.poses: list[tuple[float, ...]] = []
        self.colours: list[tuple[int, int, int]] = []
        self.feedback: list[float] = []
        self.results: list[float] = []
        self.clamped: list[tuple[float, float]] = []
        self.path = PathImage()
        self.world = World()
        self.turtle = self.world.spawn_centred()
        commands = read_json(name, "commands.json")["commands"]
        for row in self.rows:
            now_s = float(row["t"])
            while commands and commands[0]["t"] <= now_s - SEND_TO_RECEIVE:
                self._command(commands.pop(0))
            self._tick(round(now_s * 1e9))

    def _command(self, command: dict) -> None:
        if command["kind"] == "cmd_vel":
            self.turtle.drive(command["linear_x"], 0.0, command["angular_z"])
        elif command["kind"] == "send_goal":
            self.turtle.rotate_to(float32(command["theta"]))
        elif command["kind"] == "service" and command["name"].endswith("/teleport_absolute"):
            request = command["request"]
            self.turtle.teleport_absolute(
                float32(request["x"]), float32(request["y"]), float32(request["theta"])
            )

    def _tick(self, now_ns: int) -> None:
        (tick,) = self.world.step(now_ns)
        self.poses.append(tuple(float32(value) for value in tick.pose))
        if tick.clamped_from:
            self.clamped.append(tick.clamped_from)
        if tick.rotation:
            self.feedback.append(float32(tick.rotation.remaining))
            if tick.rotation is not self.turtle.rotation:
                self.results.append(float32(tick.rotation.delta))
        for stroke in tick.teleport_strokes:
            self.path.draw(stroke)
        self.colours.append(self.path.colour_at(*tick.sensor_pixel))
        if tick.move_stroke:
            self.path.draw(tick.move_stroke)


@pytest.fixture(scope="module")
def replays() -> dict[str, Replay]:
    return {name: Replay(name) for name in TRACES}


def test_every_trace_of_the_shelf_is_replayed():
    files = [name.split("/") for name in TRACED]
    assert {trace for trace, _ in files} == TRACES.keys()
    assert {trace for trace, file in files if file == "path_pixels.json"} == PICTURES.keys()
    assert sum(TRACES.values()) == 2397


@pytest.mark.parametrize("name", TRACES)
def test_poses_are_bit_equal(replays, name):
    replay = replays[name]
    golden = [
        tuple(
            float32(float(row[field]))
            for field in ("x", "y", "theta", "linear_velocity", "angular_velocity")
        )
        for row in replay.rows
    ]
    assert len(golden) == TRACES[name]
    assert replay.poses == golden


@pytest.mark.parametrize("name", TRACES)
def test_colours_are_equal(replays, name):
    replay = replays[name]
    changes = [
        (int(row["tick"]), *colour)
        for row, colour, before in zip(
            replay.rows, replay.colours, [None, *replay.colours], strict=False
        )
        if colour != before
    ]
    assert changes == [
        tuple(int(row[field]) for field in ("tick", "r", "g", "b"))
        for row in read_csv(name, "colours.csv")
    ]


def test_feedback_and_results_of_rotations_are_equal(replays):
    replay = replays["rotate_absolute"]
    golden = [
        float32(float(row["remaining"])) for row in read_csv("rotate_absolute", "feedback.csv")
    ]
    assert len(golden) == 492
    assert replay.feedback == golden
    results = [
        command["delta"]
        for command in read_json("rotate_absolute", "commands.json")["commands"]
        if command["kind"] == "result"
    ]
    assert len(results) == 4
    assert replay.results == results


@pytest.mark.parametrize(("name", "lines"), [("teleport_absolute", 2), ("wall", 90)])
def test_wall_warnings_are_equal(replays, name, lines):
    golden = [
        line.split("]: ")[1] for line in read_json(name, "commands.json")["log"] if "[WARN]" in line
    ]
    assert len(golden) == lines
    assert [
        f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y:f}])"
        for x, y in replays[name].clamped
    ] == golden


@pytest.mark.parametrize(("name", "drawn"), PICTURES.items())
def test_path_pictures(replays, name, drawn):
    golden = read_json(name, "path_pixels.json")
    wanted = {
        (column, row): tuple(bytes.fromhex(colour))
        for row, first, last, colour in golden["runs"]
        for column in range(first, last + 1)
    }
    rgba = replays[name].path.rgba()
    ours = {
        (i // 4 % 500, i // 2000): tuple(rgba[i : i + 3])
        for i in range(0, len(rgba), 4)
        if rgba[i + 3]
    }
    assert len(wanted) == drawn
    wrong = {pixel for pixel in wanted.keys() | ours.keys() if wanted.get(pixel) != ours.get(pixel)}
    assert len(wrong) <= 0.01 * drawn
    for column, row in wrong:  # each by one pixel: a drawn one is next to it in the other picture
        neighbours = {(column + dx, row + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
        assert neighbours & wanted.keys()
        assert neighbours & ours.keys()


def test_width_zero_draws_one_pixel_lines():
    path = PathImage()
    world = World()
    turtle = world.spawn_centred()
    turtle.set_pen(Pen(1, 2, 3, 0), off=False)
    turtle.drive(2.0, 0.0, 0.0)
    for tick in range(20):
        (result,) = world.step(tick * 16_000_000)
        path.draw(result.move_stroke)
    rgba = path.rgba()
    rows = {i // 2000 for i in range(0, len(rgba), 4) if rgba[i + 3]}
    assert rows == {249}
    assert path.colour_at(255, 249) == (1, 2, 3)
