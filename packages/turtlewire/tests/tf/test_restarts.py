"""A simulation that starts again is noticed, and only that."""

from __future__ import annotations

from turtlewire import Buffer
from turtlewire.tf.restarts import RestartWatch

SECOND = 1_000_000_000
POSE = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


def test_a_world_that_begins_anew_is_forgotten():
    buffer = Buffer()
    restarts = RestartWatch(buffer)
    assert buffer.set_transform("world", "base", 0, *POSE, static=True) == ""
    assert buffer.set_transform("world", "robot", 100 * SECOND, *POSE) == ""
    assert not restarts.look()
    late = buffer.set_transform("world", "robot", SECOND, *POSE)
    assert late.startswith("TF_OLD_DATA")
    buffer.set_transform("world", "robot", 101 * SECOND, *POSE)
    assert not restarts.look()  # one late message; it still goes on
    buffer.set_transform("world", "robot", 2 * SECOND, *POSE)
    assert restarts.look()
    assert buffer.set_transform("world", "robot", 3 * SECOND, *POSE) == ""
    assert not restarts.look()
    assert buffer.lookup_transform("world", "robot").stamp_ns == 3 * SECOND
    assert buffer.can_transform("world", "base")
