"""Forward kinematics: where all links are, for many joint states at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from turtlewire.geometry import arrays
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.urdf.joint_model import NUMBER_OF_CONSTANTS, joint_constants
from turtlewire.urdf.mimic import followers_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike, NDArray

    from turtlewire.urdf.model import Robot

    Array: TypeAlias = NDArray[np.float64]

__all__ = ["Kinematics", "transforms_at"]


class Kinematics:
    """Poses of a robot's links as functions of its joints' positions.

    Fixed joints do not move; floating and planar ones stay at their origin, because one number
    cannot say where they are.

    Attributes:
        robot: The robot.
        joints: Names of the free joints, in the order of the file: revolute, continuous and
            prismatic ones that follow no other. Their positions are the columns of joint states.
        links: Names of the links, parents before children; the second axis of the poses.
        followers: How each mimic joint follows a free one.
        lower: Lower limits of ``joints``, in radians or metres; -inf for continuous joints.
        upper: Upper limits of ``joints``; inf for continuous joints.
    """

    def __init__(self, robot: Robot) -> None:
        """Prepare the arrays.

        Args:
            robot: The robot.

        Raises:
            UrdfError: Joints mimic each other in a loop.
        """
        self.robot = robot
        self.followers = followers_of(robot)
        self.joints = tuple(
            joint.name
            for joint in robot.joints.values()
            if joint.moves and joint.name not in self.followers
        )
        self._column = {name: column for column, name in enumerate(self.joints)}
        levels = _levels(robot)
        self.links = (robot.root, *(joint for level in levels for joint in level))
        index = {name: number for number, name in enumerate(self.links)}
        above = [robot.parent_joints[name] for name in self.links[1:]]
        self._constants: Array = np.array(
            [joint_constants(joint) for joint in above], dtype=np.float64
        ).reshape(len(above), NUMBER_OF_CONSTANTS)
        self._parents = np.array([index[joint.parent] for joint in above], dtype=np.intp)
        self._ends = np.cumsum([len(level) for level in levels], dtype=np.intp).tolist()
        self._sources, self._factors, self._offsets = self._drives([joint.name for joint in above])
        self.lower, self.upper = self._limits()

    def joint_states(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> Array:
        """Joint positions as an array.

        Args:
            positions: Either positions by name of the joint, each a number or an array of N
                numbers (joints not named are at 0), or an array (joints,) or (N, joints).

        Returns:
            (N, joints) float64, in radians or metres; N is 1 for single states.

        Raises:
            KeyError: No free joint has that name.
            ValueError: The shapes do not fit.
        """
        if not hasattr(positions, "items"):
            states = np.atleast_2d(np.asarray(positions, dtype=np.float64))
            if states.ndim != 2 or states.shape[1] != len(self.joints):
                raise ValueError(
                    f"expected joint states of shape (N, {len(self.joints)}), one column for each"
                    f" free joint, got {np.shape(positions)}"
                )
            return states
        named = {name: np.asarray(value, np.float64) for name, value in positions.items()}
        unknown = [name for name in named if name not in self._column]
        if unknown:
            raise KeyError(self._unknown(unknown[0]))
        number = np.broadcast_shapes((1,), *(value.shape for value in named.values()))
        states = np.zeros((*number, len(self.joints)))
        for name, value in named.items():
            states[:, self._column[name]] = value
        return states

    def clipped(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> Array:
        """Joint positions (N, joints) moved into the limits; continuous joints have none."""
        return np.clip(self.joint_states(positions), self.lower, self.upper)

    def within_limits(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> NDArray[np.bool_]:
        """Return which positions of (N, joints) are within their joint's limits; False for NaN."""
        states = self.joint_states(positions)
        return (states >= self.lower) & (states <= self.upper)

    def joint_transforms(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> Array:
        """Pose of each link in its parent link, (N, links - 1, 7), for ``links[1:]``.

        Columns are x y z in metres and the quaternion x y z w.
        """
        states = self.joint_states(positions)
        padded = np.concatenate([states, np.zeros((len(states), 1))], axis=1)
        return transforms_at(
            self._constants, padded[:, self._sources] * self._factors + self._offsets
        )

    def link_poses(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> Array:
        """Pose of each link in the root link.

        Args:
            positions: As for :meth:`joint_states`. Limits are not applied.

        Returns:
            (N, links, 7) float64: x y z in metres and the unit quaternion x y z w.
        """
        local = self.joint_transforms(positions)
        poses = np.zeros((len(local), len(self.links), 7))
        poses[:, 0, 6] = 1.0
        begin = 0
        for end in self._ends:
            parents = poses[:, self._parents[begin:end]]
            below = local[:, begin:end]
            target = poses[:, begin + 1 : end + 1]
            target[..., :3] = parents[..., :3] + arrays.rotate(parents[..., 3:], below[..., :3])
            target[..., 3:] = arrays.multiply(parents[..., 3:], below[..., 3:])
            begin = end
        return poses

    def _drives(self, joints: list[str]) -> tuple[NDArray[np.intp], Array, Array]:
        """For each joint the column that drives it, factor and offset."""
        sources = np.full(len(joints), len(self.joints), dtype=np.intp)  # the column of zeros
        factors, offsets = np.ones(len(joints)), np.zeros(len(joints))
        for number, name in enumerate(joints):
            follower = self.followers.get(name)
            if follower is not None:
                sources[number] = self._column[follower.leader]
                factors[number], offsets[number] = follower.multiplier, follower.offset
            elif name in self._column:
                sources[number] = self._column[name]
        return sources, factors, offsets

    def _limits(self) -> tuple[Array, Array]:
        lower = np.full(len(self.joints), -np.inf)
        upper = np.full(len(self.joints), np.inf)
        for column, name in enumerate(self.joints):
            joint = self.robot.joints[name]
            if joint.type != "continuous" and joint.limits is not None:
                lower[column], upper[column] = joint.limits.lower, joint.limits.upper
        return lower, upper

    def _unknown(self, name: str) -> str:
        follower = self.followers.get(name)
        if follower is not None:
            return f"the joint {name!r} follows {follower.leader!r}; give that one's position"
        text = f"the robot {self.robot.name!r} has no free joint {name!r}"
        near = did_you_mean(name, self.joints)
        return f"{text}. {near}" if near else text


def transforms_at(constants: Array, positions: Array) -> Array:
    """Transforms of joints.

    Args:
        constants: (joints, 15), each row from :func:`.joint_model.joint_constants`.
        positions: (N, joints), or (joints,), in radians or metres.

    Returns:
        (N, joints, 7), or (joints, 7): x y z and the quaternion x y z w of the child in the parent.
    """
    half = positions * (0.5 * constants[:, 14])
    out = np.empty((*positions.shape, 7))
    out[..., :3] = constants[:, :3] + positions[..., None] * constants[:, 3:6]
    out[..., 3:] = (
        np.cos(half)[..., None] * constants[:, 6:10] + np.sin(half)[..., None] * constants[:, 10:14]
    )
    return out


def _levels(robot: Robot) -> list[list[str]]:
    """Links by their distance from the root, which itself is left out."""
    levels: list[list[str]] = []
    level = [robot.root]
    while level := [joint.child for name in level for joint in robot.child_joints[name]]:
        levels.append(level)
    return levels
