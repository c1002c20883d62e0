"""The lessons of learning_tf2_py after the follow demo.

Carrots, time travel and awaiting, in lock-step.
"""

import math
import re

import pytest
from learning_tf2_py.dynamic_frame_tf2_broadcaster import DynamicFrameBroadcaster
from learning_tf2_py.fixed_frame_tf2_broadcaster import FixedFrameBroadcaster
from learning_tf2_py.turtle_tf2_async_listener import AsyncListener
from learning_tf2_py.turtle_tf2_broadcaster import TurtleBroadcaster
from learning_tf2_py.turtle_tf2_listener import TurtleListener
from learning_tf2_py.turtle_tf2_time_travel import TimeTraveller
from tests.places import HOW_TO
from tests.programs import run_python

from rclpy.time import Time
from turtlesim.testing import Simulation


@pytest.fixture
def simulation():
    with Simulation() as simulation:
        simulation.spawn("turtle2", x=4.0, y=2.0)
        for turtle in ("turtle1", "turtle2"):
            simulation.start(TurtleBroadcaster, name=f"{turtle}_broadcaster", turtlename=turtle)
        yield simulation


def test_turtle2_goes_to_the_fixed_carrot(simulation):
    simulation.add(FixedFrameBroadcaster())
    simulation.start(TurtleListener, target_frame="carrot1")
    simulation.run(20.0)
    turtle1, turtle2 = simulation.pose("turtle1"), simulation.pose("turtle2")
    assert (turtle2.x, turtle2.y) == pytest.approx((turtle1.x, turtle1.y + 2.0), abs=0.1)


def test_turtle2_never_catches_the_swinging_carrot(simulation):
    simulation.add(DynamicFrameBroadcaster())
    listener = simulation.start(TurtleListener, target_frame="carrot1")
    simulation.run(3.0)
    place = listener.tf_buffer.lookup_transform("turtle1", "carrot1", Time()).transform.translation
    assert math.hypot(place.x, place.y) == pytest.approx(10.0)
    assert simulation.pose("turtle2").linear_velocity > 0.5


def test_turtle2_goes_where_turtle1_was(simulation):
    simulation.start(TimeTraveller, delay=5.0)
    simulation.run(20.0)
    there = simulation.pose("turtle1")
    reached = simulation.pose("turtle2")
    assert (reached.x, reached.y) == pytest.approx((there.x, there.y), abs=0.3)
    for _ in range(2):
        simulation.drive("turtle1", linear=1.5)
        simulation.run(1.0)
    still = simulation.pose("turtle2")
    assert (still.x, still.y) == pytest.approx(
        (there.x, there.y), abs=0.1
    )  # it follows five seconds behind
    simulation.run(10.0)
    assert simulation.distance("turtle1", "turtle2") < 0.3


def test_turtle2_is_driven_by_transforms_that_are_awaited(simulation):
    listener = simulation.start(AsyncListener)
    asked = []
    wait = listener.tf_buffer.wait_for_transform_async
    listener.tf_buffer.wait_for_transform_async = lambda *args: (
        asked.append(answer := wait(*args)) or answer
    )
    simulation.run(20.0)
    assert simulation.distance("turtle1", "turtle2") < 0.1
    assert len(asked) > 150
    assert all(answer.done() for answer in asked[:-1])  # one after the other


# The program of the how-to page prints what the page says.


PAGE = HOW_TO / "simulate.md"


def test_the_page_does_what_it_says():
    (program, printed), *others = re.findall(
        r"^```python\n(.*?)^```\n\n```text\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL
    )
    assert not others
    run = run_python(program)
    assert run.stdout == printed
