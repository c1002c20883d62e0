"""The transforms of a robot's links in a buffer."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from turtlewire.tf.buffer import Buffer

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from turtlewire.urdf.kinematics import Kinematics

__all__ = ["buffer_of"]


def buffer_of(
    kinematics: Kinematics,
    positions: Mapping[str, ArrayLike] | ArrayLike,
    stamps: ArrayLike | None,
) -> Buffer:
    """Return a buffer with all links; see `Robot.transforms`."""
    local = kinematics.joint_transforms(positions)
    if stamps is None and len(local) != 1:
        raise ValueError(f"{len(local)} rows of positions need as many stamps: pass `stamps`")
    if stamps is not None and np.shape(stamps) != (len(local),):
        raise ValueError(
            f"expected stamps of shape ({len(local)},), one for each row of the positions; got "
            f"{np.shape(stamps)}"
        )
    buffer = Buffer(cache_time_ns=None)
    for number, link in enumerate(kinematics.links[1:]):
        joint = kinematics.robot.parent_joints[link]
        poses = local[:, number]
        if joint.moves and stamps is not None:
            buffer.set_transforms(joint.parent, link, stamps, poses)
        elif len(poses):
            pose = poses[0].tolist()
            buffer.set_static_transform(joint.parent, link, pose[:3], pose[3:])
    return buffer
