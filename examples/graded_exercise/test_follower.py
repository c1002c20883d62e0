"""The teacher's tests of `follower.py`."""

import pytest
from broadcaster import Broadcaster
from follower import Follower

from turtlesim.testing import Simulation


@pytest.fixture
def chase(simulation: Simulation) -> Simulation:
    """Two turtles that TF knows, and the follower."""
    simulation.spawn("turtle2", x=4.0, y=2.0)
    for turtle in ("turtle1", "turtle2"):
        simulation.start(Broadcaster, name=f"{turtle}_broadcaster", turtlename=turtle)
    simulation.add(Follower())
    return simulation


def test_turtle2_reaches_a_turtle_that_stands_still(chase: Simulation) -> None:
    """Within half a metre in ten seconds."""
    assert chase.run_until(lambda: chase.distance("turtle1", "turtle2") < 0.5, within=10.0)


def test_turtle2_keeps_up_with_a_turtle_on_a_circle(chase: Simulation) -> None:
    """Never further away than two metres, once it had ten seconds to catch up."""
    largest = 0.0
    for second in range(20):
        chase.drive("turtle1", linear=1.0, angular=0.5)
        chase.run(1.0)
        if second >= 10:
            largest = max(largest, chase.distance("turtle1", "turtle2"))
    assert largest < 2.0


def test_turtle2_comes_to_rest(chase: Simulation) -> None:
    """It stops where turtle1 is."""
    chase.run(30.0)
    assert chase.pose("turtle2").linear_velocity < 0.05
