"""The joints of a robot and their present values; no ROS, no XML."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple


class MimicLoopError(ValueError):
    """Joints mimic each other in a cycle."""


@dataclass
class FreeJoint:
    """A joint whose value is chosen.

    Attributes:
        name: Name of the joint.
        kind: The type in the description: ``revolute``, ``prismatic``, ``continuous`` …
        minimum: Lower limit [rad or m].
        maximum: Upper limit [rad or m].
        zero: The value at the start and after a centring [rad or m].
        max_velocity: The velocity limit [rad/s or m/s]; None without one.
        position: Present position [rad or m]; None if no positions are published.
        velocity: Present velocity [rad/s or m/s]; None if no velocities are published.
        effort: Present effort [N m or N]; None if no efforts are published.
        forward: The direction in which :meth:`sweep` goes next.
    """

    name: str
    kind: str
    minimum: float
    maximum: float
    zero: float
    max_velocity: float | None = None
    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    forward: bool = True

    @property
    def continuous(self) -> bool:
        """True if the joint turns endlessly."""
        return self.kind == "continuous"

    def clipped(self, position: float) -> float:
        """Return the position within the limits."""
        return min(max(position, self.minimum), self.maximum)

    def sweep(self, step: float) -> None:
        """Move by one step. Turn at the limits; a continuous joint restarts at its minimum."""
        if self.position is None:
            return
        if self.forward:
            self.position += step
            if self.position > self.maximum:
                self.position = self.minimum if self.continuous else self.maximum
                self.forward = self.continuous
        else:
            self.position -= step
            if self.position < self.minimum:
                self.position = self.minimum
                self.forward = True


class MimicRule(NamedTuple):
    """The formula of a joint that follows another: ``factor * parent + offset``."""

    parent: str
    factor: float = 1.0
    offset: float = 0.0


class State(NamedTuple):
    """The content of a JointState message, in the order of the joints in the description."""

    names: list[str]
    positions: list[float]
    velocities: list[float]
    efforts: list[float]


@dataclass
class JointSet:
    """All joints of one description that move; its methods may be called from any thread.

    Attributes:
        robot: Name of the robot.
        order: Names in the order of the description.
        free: The joints whose value is chosen.
        mimics: The joints that follow another one.
        kinds: The type of each joint.
        lock: Held by every method; hold it to read or change several joints at once.
    """

    robot: str = ""
    order: list[str] = field(default_factory=list)
    free: dict[str, FreeJoint] = field(default_factory=dict)
    mimics: dict[str, MimicRule] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    lock: threading.RLock = field(default_factory=threading.RLock, repr=False, compare=False)

    def source_of(self, name: str) -> tuple[FreeJoint, MimicRule]:
        """Return the free joint that a joint follows in the end, and by which formula.

        A free joint follows itself.

        Raises:
            MimicLoopError: The joint follows itself over others.
        """
        chain = [name]
        factor, offset = 1.0, 0.0
        while (mimic := self.mimics.get(chain[-1])) is not None:
            if mimic.parent in chain:
                raise MimicLoopError(
                    f"Found an infinite recursive mimic chain: {[*chain, mimic.parent]}"
                )
            # The formulas are nested: f * (g * x + h) + o = (f * g) * x + (f * h + o).
            offset += factor * mimic.offset
            factor *= mimic.factor
            chain.append(mimic.parent)
        return self.free[chain[-1]], MimicRule(chain[-1], factor, offset)

    def sweep(self, step: float) -> None:
        """Move each free joint by ``step`` between its limits."""
        with self.lock:
            for joint in self.free.values():
                joint.sweep(step)

    def take(
        self,
        names: Sequence[str],
        positions: Sequence[float],
        velocities: Sequence[float],
        efforts: Sequence[float],
    ) -> None:
        """Take over the values of the free joints among ``names``; an empty list changes nothing.

        Raises:
            ValueError: A list that is not empty has another length than ``names``.
        """
        for label, values in (
            ("position", positions),
            ("velocity", velocities),
            ("effort", efforts),
        ):
            if len(values) not in (0, len(names)):
                raise ValueError(f"{len(names)} names but {len(values)} values of {label}")
        with self.lock:
            for index, name in enumerate(names):
                joint = self.free.get(name)
                if joint is None:
                    continue
                if positions:
                    joint.position = positions[index]
                if velocities:
                    joint.velocity = velocities[index]
                if efforts:
                    joint.effort = efforts[index]

    def state(self) -> State:
        """Return the values of all joints, with mimic joints computed."""
        state = State(list(self.order), [], [], [])
        with self.lock:
            for name in self.order:
                joint, (_, factor, offset) = self.source_of(name)
                state.positions.append((joint.position or 0.0) * factor + offset)
                state.velocities.append((joint.velocity or 0.0) * factor)
                # As in ROS 2, the factor does not apply to efforts.
                state.efforts.append(joint.effort or 0.0)
            free = list(self.free.values())
            # As in ROS 2, an array has a value for every joint or is empty.
            return State(
                state.names,
                state.positions if any(joint.position is not None for joint in free) else [],
                state.velocities if any(joint.velocity is not None for joint in free) else [],
                state.efforts if any(joint.effort is not None for joint in free) else [],
            )
