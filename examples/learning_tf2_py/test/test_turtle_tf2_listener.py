import math

import pytest
from learning_tf2_py.turtle_tf2_listener import twist_towards


@pytest.mark.parametrize(
    ("x", "y", "forward", "turn"),
    [
        (2.0, 0.0, 1.0, 0.0),
        (0.0, 2.0, 1.0, math.pi / 2),
        (0.0, -2.0, 1.0, -math.pi / 2),
        (-3.0, 4.0, 2.5, math.atan2(4.0, -3.0)),
        (0.0, 0.0, 0.0, 0.0),
    ],
)
def test_it_turns_to_the_target_and_goes_there(x, y, forward, turn):
    command = twist_towards(x, y)
    assert command.linear.x == pytest.approx(forward)
    assert command.angular.z == pytest.approx(turn)
    assert command.linear.y == command.linear.z == command.angular.x == command.angular.y == 0.0
