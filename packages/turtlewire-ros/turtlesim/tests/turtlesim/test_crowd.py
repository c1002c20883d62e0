"""Very many turtles at once: the same bits as one by one."""

from __future__ import annotations

import random
import struct

import numpy as np
import pytest

from rclpy.publisher import Publisher
from turtlesim import turtle_endpoints, turtlesim_node
from turtlesim.crowd import Crowd
from turtlesim.drawing import StrokeHistory
from turtlesim.model import TICK_NS, Pen, World
from turtlesim.msg import Color, Pose
from turtlesim.path import PathImage
from turtlesim.testing import Simulation


def populate(world: World, count: int) -> None:
    numbers = random.Random(5)
    for _ in range(count):
        turtle = world.spawn(
            numbers.uniform(-1, 12), numbers.uniform(-1, 12), numbers.uniform(-9, 9)
        )
        turtle.set_pen(
            Pen(*(numbers.randrange(256) for _ in range(3)), numbers.randrange(5)),
            off=numbers.random() < 0.2,
        )


def command(world: World, numbers: random.Random) -> None:
    for turtle in world.turtles.values():
        if numbers.random() < 0.02:
            turtle.drive(
                numbers.uniform(-3, 3),
                numbers.choice((0.0, numbers.uniform(-2, 2))),
                numbers.uniform(-4, 4),
            )


def test_a_crowd_moves_as_its_turtles_do_one_by_one():
    """Over five seconds of random commands: poses, strokes, sensors and walls, bit for bit."""
    alone, together, crowd = World(), World(), Crowd()
    boards = StrokeHistory(), StrokeHistory()
    for world in (alone, together):
        populate(world, 150)
    numbers = random.Random(7), random.Random(7)
    walls = 0
    for k in range(1, 313):
        command(alone, numbers[0])
        command(together, numbers[1])
        singles = alone.step(k * TICK_NS)
        tick = crowd.step(together.in_order(), k * TICK_NS)
        assert [turtle.name for turtle in tick.turtles] == [
            single.turtle.name for single in singles
        ]
        assert tick.poses.tobytes() == b"".join(
            struct.pack("<5f", *single.pose) for single in singles
        )
        assert [tick.sensor_pixel(index) for index in range(150)] == [
            single.sensor_pixel for single in singles
        ]
        assert tick.clamped_from == [
            single.clamped_from for single in singles if single.clamped_from
        ]
        drew = [
            (index, single.move_stroke)
            for index, single in enumerate(singles)
            if single.move_stroke
        ]
        assert tick.movers.tolist() == [index for index, _ in drew]
        assert [
            (*line, Pen(*pen))
            for line, pen in zip(tick.lines.tolist(), tick.pens.tolist(), strict=True)
        ] == [s for _, s in drew]
        for _, stroke in drew:
            boards[0].add("somebody", stroke)
        boards[1].add_records(tick.stroke_records())
        walls += len(tick.clamped_from)
    assert walls > 100
    assert boards[0].since(-1) == boards[1].since(-1)


def test_the_simulator_shows_the_same_either_way(monkeypatch):
    """Colours as the sensors see them between the strokes of one tick, commands, a rotation and a
    teleport in between.
    """
    one_by_one = _story()
    monkeypatch.setattr(turtlesim_node, "_CROWD", 1)
    assert _story() == one_by_one


def _story() -> list:
    heard: list = []
    with Simulation() as simulation:
        for k in range(12):
            simulation.spawn(x=5.0 + 0.05 * k, y=5.0, theta=0.1 * k)
        for k in range(1, 14):
            for kind, topic in ((Pose, "pose"), (Color, "color_sensor")):
                simulation._driver.create_subscription(
                    kind, f"/turtle{k}/{topic}", lambda message, k=k: heard.append((k, message)), 10
                )
        for second in range(3):
            for k in range(1, 14):
                simulation.drive(f"turtle{k}", linear=0.3 * k, angular=0.7 * second)
            simulation.run(0.4)
            simulation.node.world.turtles["turtle3"].teleport_absolute(2.0, 2.0, 1.0)
            simulation.node.world.turtles["turtle4"].rotate_to(second - 0.5)
            simulation.run(0.6)
        picture = simulation.node._path.rgba()
    assert len(heard) > 4000
    assert len({str(message) for _, message in heard if type(message).__name__ == "Color"}) > 1
    return [*heard, picture]


@pytest.mark.parametrize("crowd_from", [1, 10_000])
def test_messages_without_a_subscription_are_not_created(monkeypatch, crowd_from):
    """No message is made or published and no pixel looked up while a topic has no subscription."""
    done: list[str] = []
    monkeypatch.setattr(turtlesim_node, "_CROWD", crowd_from)
    monkeypatch.setattr(PathImage, "colour_at", lambda *_: done.append("look") or (1, 2, 3))
    publish = Publisher.publish

    def record(publisher, message):
        if publisher.topic_name.endswith(("/pose", "/color_sensor")):
            done.append(publisher.topic_name)
        publish(publisher, message)

    monkeypatch.setattr(Publisher, "publish", record)
    with Simulation() as simulation:
        simulation.spawn("turtle2", x=2.0, y=2.0)
        for kind in (Pose, Color):
            monkeypatch.setattr(
                turtle_endpoints,
                kind.__name__,
                lambda kind=kind, **fields: done.append("make") or kind(**fields),
            )
        simulation.step(3)
        assert done == []
        listener = simulation._driver.create_subscription(
            Color, "/turtle2/color_sensor", lambda _: None, 1
        )
        simulation.come_to_rest()
        simulation.step()
        assert done == ["look", "make", "/turtle2/color_sensor"]
        simulation._driver.destroy_subscription(listener)
        simulation.come_to_rest()
        simulation.step(3)
        assert len(done) == 3
        simulation._driver.create_subscription(Pose, "/turtle1/pose", lambda _: None, 1)
        simulation.come_to_rest()
        simulation.step()
        assert done[3:] == ["/turtle1/pose"]


def test_a_drawing_keeps_the_newest_strokes_of_a_crowd(monkeypatch):
    monkeypatch.setattr("turtlesim.drawing._OLDER", 25)
    board = StrokeHistory()
    chunks = [np.full(50, k, dtype="<u4").tobytes() for k in range(9)]  # ten records each
    for chunk in chunks[:5]:
        board.add_records(chunk)
    restart, records, position = board.since(-1)
    assert (restart, records) == (True, b"".join(chunks[3:5]))
    board.add_records(chunks[5])
    assert board.since(position) == (False, chunks[5], position + 10)
    for chunk in chunks[6:]:
        board.add_records(chunk)
    restart, records, _ = board.since(position)
    assert (restart, records) == (True, b"".join(chunks[7:]))
