"""Bags and trajectories that all adapters read; one of our processes creates them once."""

import os
import random
import struct
from pathlib import Path

#: Messages of one transform each; and messages of `LINKS` transforms each.
SINGLE, SEVERAL, LINKS = 1_000_000, 100_000, 20
POSES = 100_000
START = 1_700_000_000 * 10**9


def folder():
    return Path(os.environ["BENCHMARK_BAGS"])


def tf_messages(count, links, period_ns):
    """Stamp and CDR bytes of messages whose numbers do not compress to nothing."""
    from turtlewire import msg

    stamped = msg.get_message("geometry_msgs/msg/TransformStamped")
    transforms = []
    for k in range(links):
        transform = stamped(child_frame_id=f"link_{k}")
        transform.header.frame_id = f"link_{k - 1}" if k else "odom"
        transform.header.stamp.sec, transform.header.stamp.nanosec = 0x11223344, k + 1
        transform.transform.translation.x = 1234.5
        transform.transform.rotation.w = 1.0
        transforms.append(transform)
    template = msg.serialize(msg.get_message("tf2_msgs/msg/TFMessage")(transforms=transforms))
    stamps = [template.index(struct.pack("<iI", 0x11223344, k + 1)) for k in range(links)]
    numbers = [template.index(struct.pack("<d", 1234.5), at) for at in stamps]
    data, dice = bytearray(template), random.Random(1)
    for i in range(count):
        stamp = START + i * period_ns
        for at in stamps:
            struct.pack_into("<iI", data, at, stamp // 10**9, stamp % 10**9)
        for at in numbers:
            struct.pack_into("<d", data, at, dice.random())
        yield stamp, bytes(data)


def trajectories():
    """Stamps (ns), and positions and quaternions (xyzw) of a reference and of an estimate."""
    import numpy as np

    dice = np.random.default_rng(1)
    reference = np.cumsum(dice.normal(size=(POSES, 3)), axis=0) * 0.01
    turns = np.cumsum(dice.normal(size=(POSES, 4)) * 0.001, axis=0)
    turns[:, 3] += 1
    estimate = reference + dice.normal(size=(POSES, 3)) * 0.05
    other = turns + dice.normal(size=(POSES, 4)) * 0.01
    turns, other = (q / np.linalg.norm(q, axis=1, keepdims=True) for q in (turns, other))
    return START + np.arange(POSES) * 10_000_000, reference, turns, estimate, other
