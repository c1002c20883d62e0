"""The data for every rival.

A chain of four frames at 1 kHz over ten seconds, all three links moving.
"""

import math

FRAMES = ["map", "odom", "base", "camera"]
FIRST = 1_700_000_000_000_000_000
STEP = 1_000_000
SAMPLES = 10_001
LAST = FIRST + (SAMPLES - 1) * STEP
RECENT = LAST - 5 * STEP - STEP // 2
OLD = LAST - 9000 * STEP - STEP // 2
LINKS_IN_MESSAGE = 100


def pose(link, i):
    """(x, y, z, qx, qy, qz, qw) of sample i of a link."""
    angle = 0.001 * i * (link % 3 + 1)
    return (
        math.sin(angle),
        math.cos(angle),
        0.1 * link,
        0.0,
        0.0,
        math.sin(angle / 2),
        math.cos(angle / 2),
    )


def chain():
    """(parent, child, stamp, pose) of all samples, in order of time."""
    for i in range(SAMPLES):
        for link in range(3):
            yield FRAMES[link], FRAMES[link + 1], FIRST + i * STEP, pose(link, i)


def random_stamps(n):
    """Stamps all over the ten seconds, the same for everyone."""
    state, stamps = 12345, []
    for _ in range(n):
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        stamps.append(FIRST + (state >> 16) % (LAST - FIRST))
    return stamps


def message(i, links):
    """The transforms of TFMessage i: (parent, child, stamp, pose)."""
    return [
        ("base_link", f"robot_link_{k:03d}", FIRST + i * STEP, pose(k, i)) for k in range(links)
    ]


def arrays(count):
    """Stamps in order, and a row of x, y, z, qx, qy, qz, qw for each, turned at random."""
    import numpy as np  # not in every interpreter

    poses = np.random.default_rng(1).normal(size=(count, 7))
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1)[:, None]
    return np.arange(count, dtype=np.int64) * STEP + FIRST, poses
