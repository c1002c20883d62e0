"""The square: its plan on the model without ROS, tick by tick, and its words."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from turtlesim.draw_square import SquarePlan, _left_of
from turtlesim.model import TICK_NS, World


def test_four_sides_and_four_turns_come_back_to_the_start():
    log: list[str] = []
    plan = SquarePlan(log.append)
    world = World()
    turtle = world.spawn_centred()
    corners = []
    for tick in range(6000):
        (result,) = world.step(tick * TICK_NS)
        said = len(log)
        forward, turning = plan.command(result.pose)
        turtle.drive(forward, 0.0, turning)
        if "Reached goal" in log[said:]:
            corners.append((result.pose.x, result.pose.y))
        if len(corners) == 8:
            break
    assert len(corners) == 8
    middle = 5.544445
    for (x, y), (right, up) in zip(corners[::2], [(2, 0), (2, 2), (0, 2), (0, 0)], strict=True):
        assert (x, y) == (
            pytest.approx(middle + right, abs=0.25),
            pytest.approx(middle + up, abs=0.25),
        )
    assert turtle.theta == pytest.approx(0.0, abs=0.05)
    assert log[0] == "New goal [7.544445 5.544445, 0.000000]"
    assert [line.split(" [")[0] for line in log] == [
        "New goal",
        *(8 * ["Reached goal", "New goal"]),
    ]


def test_a_turn_to_the_left_ends_between_minus_pi_and_pi():
    headings = (0.0, math.pi / 2, 0.75 * math.pi, math.pi)
    turned = [_left_of(SimpleNamespace(x=1.0, y=2.0, theta=theta)).theta for theta in headings]
    assert turned == pytest.approx([math.pi / 2, math.pi, -0.75 * math.pi, -math.pi / 2])
