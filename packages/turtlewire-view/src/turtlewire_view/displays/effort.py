"""Efforts of joints: torques as rings and forces as arrows at the joints of a robot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.urdf import Robot, UrdfError
from turtlewire.wording import counted
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    Status,
    UnusableMessageError,
)
from turtlewire_view.displays.points import rainbow

if TYPE_CHECKING:
    from turtlewire.urdf.model import Joint

__all__ = ["EffortDisplay"]

_DESCRIPTION = "std_msgs/msg/String"
_LONGEST_DESCRIPTION = 16 * 2**20
#: As in RViz, for a joint without a limit: the share of 1 N m or N in the largest ring.
_SHARE_OF_ONE = 0.05
_SHAPES = {"revolute": "ring", "continuous": "ring", "prismatic": "arrow"}
_LARGEST_SHARE = 1e6


class EffortDisplay(Display):
    """The efforts of a ``sensor_msgs/msg/JointState``, at the joints of a robot.

    The header has ``joints``: ``name``, ``frame`` (of the child link), ``axis`` in it, ``shape``
    (``ring`` about the axis or ``arrow`` along it), ``share`` of the greatest effort with the
    effort's sign, and ``color``. Options: ``description_topic`` is where the robot's URDF comes
    from; ``tf_prefix`` stands before the links' names; ``joints`` may have a greatest effort
    (``max``) in place of the URDF's; ``history_length`` messages are kept.
    """

    kind = "effort"
    replays = True

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._joints: dict[str, Joint] | None = None
        self._problem = ""

    def topics(self, type_name: str) -> dict[str, str]:
        """Return the topics of the robot's description and of the joint states."""
        description = self.options.text("description_topic")
        robot = {description: _DESCRIPTION} if description and description != self.topic else {}
        return robot | {self.topic: type_name}

    def start(self) -> list[Output]:
        """Other options restart the history."""
        gone: list[Output] = [Removal(part) for part in self._parts]
        self._parts.clear()
        return gone

    def take(self, topic: str, message: Any) -> list[Output]:
        """Return the efforts of joint states, or the status of a description."""
        if topic == self.topic:
            return self.content(message)
        self._read(message.data)
        return [Status.of("error" if self._problem else "ok", self._problem)]

    def _read(self, text: str) -> None:
        self._joints, self._problem = None, ""
        if len(text) > _LONGEST_DESCRIPTION:
            self._problem = f"a description of {len(text)} characters is too long"
            return
        try:
            self._joints = dict(Robot.from_xml(text).joints)
        except UrdfError as error:
            self._problem = f"the description is invalid: {error}"

    def _outputs(self, message: Any) -> list[Output]:
        if self._problem:
            raise UnusableMessageError(self._problem)
        if self._joints is None:
            topic = self.options.text("description_topic")
            self.warn(f"No robot description received on [{topic}]")
            return []
        if len(message.effort) != len(message.name):
            raise UnusableMessageError(
                f"the joint states have {counted(len(message.name), 'name')} and "
                f"{counted(len(message.effort), 'effort')}"
            )
        known = {
            name: float(effort)
            for name, effort in zip(message.name, message.effort, strict=True)
            if name in self._joints and self._joints[name].type in _SHAPES
        }
        if message.name and not known:
            self.warn(f"the message has no joint of the robot; its first is '{message.name[0]}'")
        joints = [entry for item in known.items() if (entry := self._entry(*item)) is not None]
        return self._keep(Content({"joints": joints}), self.options.number("history_length"))

    def _entry(self, name: str, effort: float) -> dict[str, Any] | None:
        """Return the drawing of a joint; None if its effort is not finite."""
        assert self._joints is not None
        joint = self._joints[name]
        length = math.hypot(*joint.axis)
        if not math.isfinite(effort) or not 0 < length < math.inf:
            self.warn(f"joint '{name}': the effort {effort} or the axis cannot be drawn")
            return None
        share = self._share(joint, effort)
        prefix = self.options.text("tf_prefix").rstrip("/")
        color = rainbow(np.array([min(1.0, abs(share))]))[0].tolist()
        return {
            "name": name,
            "frame": f"{prefix}/{joint.child}" if prefix else joint.child,
            "axis": [value / length for value in joint.axis],
            "shape": _SHAPES[joint.type],
            "share": share,
            "color": color,
        }

    def _share(self, joint: Joint, effort: float) -> float:
        """Return the effort as a share of the joint's greatest one, as RViz does."""
        chosen = self.options["joints"]
        own = chosen.get(joint.name, {}).get("max") if isinstance(chosen, dict) else None
        limit = joint.limits.effort if joint.limits is not None else 0.0
        greatest = float(own or limit)
        if greatest > 0 and math.isfinite(greatest):
            return max(-1.0, min(1.0, effort / greatest))
        return max(-_LARGEST_SHARE, min(_LARGEST_SHARE, effort * _SHARE_OF_ONE))
