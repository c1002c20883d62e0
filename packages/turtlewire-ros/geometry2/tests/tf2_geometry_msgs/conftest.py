"""Transforms of messages, and their equivalents in SciPy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from geometry_msgs.msg import TransformStamped


class World:
    """A transform as a message and as a SciPy rotation with a translation."""

    def __init__(
        self,
        translation=(1.0, -2.0, 3.0),
        rotation=(0.0, 0.0, 0.0, 1.0),
        target="target",
        source="source",
    ):
        self.rotation = Rotation.from_quat(rotation)
        self.translation = np.array(translation, dtype=float)
        self.message = TransformStamped(child_frame_id=source)
        self.message.header.frame_id = target
        self.message.header.stamp.sec, self.message.header.stamp.nanosec = 12, 345
        (
            self.message.transform.translation.x,
            self.message.transform.translation.y,
            self.message.transform.translation.z,
        ) = map(float, translation)
        q = self.message.transform.rotation
        q.x, q.y, q.z, q.w = map(float, rotation)

    def point(self, xyz):
        return self.rotation.apply(xyz) + self.translation

    def inverse(self):
        back = self.rotation.inv()
        return World(
            -back.apply(self.translation),
            back.as_quat(),
            target=self.message.child_frame_id,
            source=self.message.header.frame_id,
        )


@pytest.fixture(scope="session")
def make_world():
    return World


@pytest.fixture
def quarter_turn():
    """A quarter to the left about z, 10 ahead, 20 to the left and 30 up: x goes to y, y to -x."""
    return World((10.0, 20.0, 30.0), (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)))


@pytest.fixture(params=range(5))
def some_world(request):
    random = np.random.default_rng(request.param)
    return World(random.uniform(-9, 9, 3), Rotation.random(random_state=request.param).as_quat())
