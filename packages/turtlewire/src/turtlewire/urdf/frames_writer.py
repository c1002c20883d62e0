"""TFMessages in CDR whose frames stay and whose stamps and poses change."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.platforms import asked_core
from turtlewire.urdf.joint_model import joint_constants

if TYPE_CHECKING:
    from collections.abc import Sequence

    from turtlewire._native import JointFrames
    from turtlewire.urdf.model import Joint

__all__ = ["FramesWriter", "Moving", "PlainFrames"]

_ENCAPSULATION = b"\x00\x01\x00\x00"


class Moving(NamedTuple):
    """A joint that moves, its frames, and what drives it.

    Attributes:
        parent: Name of the frame of the parent link.
        child: Name of the frame of the child link.
        joint: The joint; its position is ``factor * positions[source] + offset``.
        source: Which of the positions counts.
        factor: See ``joint``.
        offset: See ``joint``.
    """

    parent: str
    child: str
    joint: Joint
    source: int
    factor: float
    offset: float


class FramesWriter:
    """Writes the transforms of the same joints again and again.

    Attributes:
        frames: What writes them, native where the core is.
    """

    def __init__(self, joints: Sequence[Moving]) -> None:
        template, stamps, poses = _template(joints)
        constants = [number for moving in joints for number in joint_constants(moving.joint)]
        drives = [(moving.factor, moving.offset) for moving in joints]
        make = _native_frames() or PlainFrames
        self.frames = make(
            template,
            stamps,
            poses,
            constants,
            [moving.source for moving in joints],
            [factor for factor, _ in drives],
            [offset for _, offset in drives],
        )

    def message(self, joint_state: bytes, positions: int) -> bytes:
        """Return a TFMessage in CDR.

        Args:
            joint_state: A JointState in CDR, whose stamp the transforms get.
            positions: Where its first position is; all positions must be there.
        """
        return self.frames.message(joint_state, positions)


class PlainFrames:
    """The plain-Python twin of ``turtlewire._native.JointFrames``."""

    def __init__(
        self,
        template: bytes,
        stamps: list[int],
        poses: list[int],
        constants: list[float],
        sources: list[int],
        factors: list[float],
        offsets: list[float],
    ) -> None:
        import numpy as np

        from turtlewire.urdf.joint_model import NUMBER_OF_CONSTANTS

        self._template = template
        self._stamps = np.add.outer(np.array(stamps, np.intp), np.arange(8))
        self._poses = np.add.outer(np.array(poses, np.intp), np.arange(56))
        self._constants = np.array(constants).reshape(len(sources), NUMBER_OF_CONSTANTS)
        self._sources = np.array(sources, np.intp)
        self._factors, self._offsets = np.array(factors), np.array(offsets)

    def message(self, joint_state: bytes, positions: int) -> bytes:
        import numpy as np

        from turtlewire.urdf.kinematics import transforms_at

        out = np.frombuffer(self._template, np.uint8).copy()
        if len(self._sources):
            out[self._stamps] = np.frombuffer(joint_state, np.uint8, 8, 4)
            count = int(self._sources.max()) + 1
            given = np.frombuffer(joint_state, "<f8", count, positions)
            with np.errstate(over="ignore", invalid="ignore"):  # infinities, as the core has them
                values = given[self._sources] * self._factors + self._offsets
                out[self._poses] = transforms_at(self._constants, values).view(np.uint8)
        made: bytes = out.tobytes()
        return made


def _native_frames() -> type[PlainFrames | JointFrames] | None:
    if asked_core() == "python":
        return None
    try:
        from turtlewire._native import JointFrames
    except ImportError:
        return None
    return JointFrames


def _template(joints: Sequence[Moving]) -> tuple[bytes, list[int], list[int]]:
    """Return the message without stamps and poses, and where they begin."""
    out = bytearray(_ENCAPSULATION + struct.pack("<I", len(joints)))
    stamps, poses = [], []
    for moving in joints:
        out += bytes(-len(out) % 4)
        stamps.append(len(out))
        out += bytes(8)
        for frame in (moving.parent, moving.child):
            text = frame.encode() + b"\0"
            out += bytes(-len(out) % 4) + struct.pack("<I", len(text)) + text
        out += bytes((4 - len(out)) % 8)
        poses.append(len(out))
        out += bytes(56)
    return bytes(out), stamps, poses
