"""Forward kinematics: the poses of all links, for many joint states at once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from turtlewire.geometry import arrays
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.tf.array_arguments import number_array
from turtlewire.urdf.joint_model import NUMBER_OF_CONSTANTS, joint_constants
from turtlewire.urdf.joints import followers_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from turtlewire.tf.buffer import Buffer
    from turtlewire.urdf.model import Description

    Array: TypeAlias = NDArray[np.float64]

__all__ = ["Kinematics", "transforms_at"]


_FULL_TURN = 2 * np.pi


class Kinematics:
    """Poses of a robot's links as functions of its joints' positions.

    Fixed joints do not move; floating and planar ones stay at their origin, because one number
    cannot say where they are.

    Attributes:
        robot: The links and joints.
        joints: Names of the free joints, in the order of the file: revolute, continuous and
            prismatic ones that follow no other. Their positions are the columns of joint states.
        links: Names of the links, parents before children; the second axis of the poses.
        followers: How each mimic joint follows a free one.
        lower: Lower limits of ``joints``, in radians or metres; -inf for continuous joints.
        upper: Upper limits of ``joints``; inf for continuous joints.
    """

    def __init__(self, robot: Description) -> None:
        """Prepare the arrays.

        Args:
            robot: The links and joints.

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
            return self._rows(positions)
        named = {name: self._column_of(name, value) for name, value in positions.items()}
        lengths = {name: len(value) for name, value in named.items() if value.shape != (1,)}
        if len(set(lengths.values())) > 1:
            counts = ", ".join(f"{name!r} has {length}" for name, length in lengths.items())
            raise ValueError(f"all joints need the same number of positions, or one: {counts}")
        states = np.zeros((next(iter(lengths.values()), 1), len(self.joints)))
        for name, value in named.items():
            states[:, self._column[name]] = value
        return states

    def _rows(self, positions: ArrayLike) -> Array:
        wanted = (
            f"positions must be a dict by name of the joint, or have the shape (N, "
            f"{len(self.joints)}), with a column for each of the joints {', '.join(self.joints)}"
        )
        try:
            rows = number_array(positions, "positions").astype(np.float64, copy=False)
        except TypeError:
            kind, advice = type(positions).__name__, ""
            if hasattr(positions, "name") and hasattr(positions, "position"):
                advice = "; write dict(zip(message.name, message.position))"
            elif isinstance(positions, list) and hasattr((positions or [0])[0], "items"):
                kind, advice = "a list of dicts", "; write {'joint': [1.0, 2.0]} for several"
            raise TypeError(f"{wanted}, not {kind}{advice}") from None
        states = np.atleast_2d(rows)
        if states.ndim != 2 or states.shape[1] != len(self.joints):
            raise ValueError(f"{wanted}, not {rows.shape if rows.ndim else 'a number'}")
        return states

    def _column_of(self, name: str, positions: ArrayLike) -> Array:
        """Return the positions of one joint, (N,); N is 1 for a number."""
        if name not in self._column:
            raise KeyError(self._unknown(name))
        column = number_array(positions, f"positions of the joint {name!r}")
        if column.ndim > 1:
            raise ValueError(
                f"the positions of the joint {name!r} must be a number or have the shape (N,), not "
                f"{column.shape}"
            )
        return np.atleast_1d(column).astype(np.float64, copy=False)

    def clip(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> Array:
        """Joint positions (N, joints) moved into the limits; continuous joints have none."""
        return np.clip(self.joint_states(positions), self.lower, self.upper)

    def within_limits(self, positions: Mapping[str, ArrayLike] | ArrayLike) -> NDArray[np.bool_]:
        """Return which positions of (N, joints) are within their joint's limits; False for NaN."""
        states = self.joint_states(positions)
        return (states >= self.lower) & (states <= self.upper)

    def in_degrees(self, states: Array) -> str:
        """Return a sentence about positions that look like degrees; empty if none do.

        Args:
            states: (N, joints); see `joint_states`.
        """
        for column, name in enumerate(self.joints):
            lower, upper, values = self.lower[column], self.upper[column], states[:, column]
            if self.robot.joints[name].type != "revolute" or lower >= upper:
                continue  # without limits, both are 0
            beyond = values[(values < lower) | (values > upper)]
            if (np.abs(beyond) > _FULL_TURN).any():
                farthest = beyond[np.argmax(np.abs(beyond))]
                return (
                    f"the position {farthest:g} of the joint {name!r} is beyond its limits, "
                    f"{lower:g} to {upper:g} rad; for degrees, write "
                    "np.radians(degrees)"
                )
        return ""

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

    def buffer(
        self, positions: Mapping[str, ArrayLike] | ArrayLike, stamps: ArrayLike | None
    ) -> Buffer:
        """Return a buffer with all links; see `Robot.transforms`."""
        from turtlewire.tf.buffer import Buffer

        local = self.joint_transforms(positions)
        if stamps is None and len(local) != 1:
            raise ValueError(f"{len(local)} rows of positions need as many stamps: pass `stamps`")
        if stamps is not None and np.shape(stamps) != (len(local),):
            raise ValueError(
                f"expected stamps of shape ({len(local)},), one for each row of the positions; got "
                f"{np.shape(stamps)}"
            )
        buffer = Buffer(cache_time_ns=None)
        for number, link in enumerate(self.links[1:]):
            joint = self.robot.parent_joints[link]
            poses, sender = local[:, number], f"joint {joint.name}"
            if joint.moves and stamps is not None:
                buffer.set_transforms(joint.parent, link, stamps, poses, sender=sender)
            elif len(poses):
                pose = poses[0].tolist()
                buffer.set_static_transform(joint.parent, link, pose[:3], pose[3:], sender=sender)
        return buffer

    def _drives(self, joints: list[str]) -> tuple[NDArray[np.intp], Array, Array]:
        """Return for each joint the column that drives it, its factor and its offset."""
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
        if name in self.robot.parent_joints:
            above = self.robot.parent_joints[name].name
            return f"{name!r} is a link, not a joint; the joint above it is {above!r}"
        if name in self.robot.joints:
            kind = self.robot.joints[name].type
            return f"the joint {name!r} is {kind}, and has no position; leave it out"
        near = did_you_mean(str(name), self.joints)
        has = near or f"It has {', '.join(self.joints) or 'none'}"
        return f"the robot {self.robot.name!r} has no free joint {name!r}. {has}"


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


def _levels(robot: Description) -> list[list[str]]:
    """Links by their distance from the root, which itself is left out."""
    levels: list[list[str]] = []
    level = [robot.root]
    while level := [joint.child for name in level for joint in robot.child_joints[name]]:
        levels.append(level)
    return levels
