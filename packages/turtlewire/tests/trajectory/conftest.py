"""Random trajectories, and their equivalents in evo."""

import warnings

import numpy as np
import pytest

from turtlewire.trajectory import Trajectory

START = 1_700_000_000_123_456_789


def random_walk(seed, count=300, step=0.1, period_ns=50_000_000):
    """A smooth random path with smooth random rotations and slightly irregular stamps."""
    dice = np.random.default_rng(seed)
    speeds = np.cumsum(dice.normal(size=(count, 3)), axis=0) * step / 10
    positions = np.cumsum(speeds, axis=0)
    turns = np.cumsum(dice.normal(size=(count, 4)) * 0.02, axis=0) + dice.normal(size=4)
    rotations = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    stamps = START + np.arange(count) * period_ns + dice.integers(0, period_ns // 4, count)
    return Trajectory(stamps, np.hstack((positions, rotations)))


def disturbed(trajectory, seed, size=0.05):
    """Return the trajectory with noise, in another frame."""
    from turtlewire.trajectory.alignment import Alignment

    dice = np.random.default_rng(seed)
    poses = trajectory.poses + dice.normal(size=trajectory.poses.shape) * size
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    q = dice.normal(size=4)
    moved = Alignment(q / np.linalg.norm(q), dice.normal(size=3) * 10, 1.0)
    jitter = dice.integers(-4_000_000, 4_000_000, len(trajectory))
    return moved.apply(Trajectory(trajectory.stamps_ns + jitter, poses))


def evo_trajectory(trajectory):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # evo and what it imports warn of one another
        from evo.core.trajectory import PoseTrajectory3D

    return PoseTrajectory3D(
        trajectory.positions.copy(),
        trajectory.rotations[:, [3, 0, 1, 2]].copy(),
        trajectory.stamps_ns / 1e9,
    )


@pytest.fixture(params=range(3))
def pair(request):
    """A reference and an estimate with the same number of poses."""
    reference = random_walk(request.param)
    return reference, disturbed(reference, request.param + 100)
