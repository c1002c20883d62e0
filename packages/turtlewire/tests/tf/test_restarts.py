"""A simulation that starts again is noticed, and only that."""

from __future__ import annotations

import pytest

from turtlewire import Buffer
from turtlewire.errors import InvalidTransformError
from turtlewire.tf.restarts import RestartWatch

SECOND = 1_000_000_000
POSE = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def test_a_world_that_begins_anew_is_forgotten():
    buffer = Buffer()
    restarts = RestartWatch(buffer)
    buffer.set_static_transform("world", "base", *POSE)
    buffer.set_transform("world", "robot", 100 * SECOND, *POSE)
    assert not restarts.look()
    with pytest.raises(InvalidTransformError, match="TF_OLD_DATA"):
        buffer.set_transform("world", "robot", SECOND, *POSE)
    buffer.set_transform("world", "robot", 101 * SECOND, *POSE)
    assert not restarts.look()  # one late message; it still goes on
    with pytest.raises(InvalidTransformError):
        buffer.set_transform("world", "robot", 2 * SECOND, *POSE)
    assert restarts.look()
    buffer.set_transform("world", "robot", 3 * SECOND, *POSE)
    assert not restarts.look()
    assert buffer.lookup_transform("world", "robot").stamp_ns == 3 * SECOND
    assert buffer.can_transform("world", "base")
