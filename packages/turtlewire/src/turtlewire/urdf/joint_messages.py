"""Converts the bytes of a JointState to the bytes of a TFMessage.

A publisher of joint states sends the same names again and again. So the names are read once, and a
:class:`Layout` keeps the results: the joints that move, the columns that drive them, and a
TFMessage in which only stamps and poses have to be filled in.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.errors import CdrError
from turtlewire.platforms import asked_core
from turtlewire.urdf.joint_model import joint_constants

if TYPE_CHECKING:
    from turtlewire._native import JointFrames, JointRelay
    from turtlewire.urdf.model import Description, Joint

__all__ = [
    "FramesWriter",
    "JointMessages",
    "Layout",
    "Moving",
    "PlainFrames",
    "stamp_of",
]

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


_FRAME_ID = 12  # where the frame_id begins: behind the encapsulation and the stamp
_MOST_LAYOUTS = 64
_STAMP = struct.Struct("<iI")
_COUNT = struct.Struct("<I")


class _Drive(NamedTuple):
    """``position of the joint = factor * positions[source] + offset``."""

    source: int
    factor: float
    offset: float


class Layout:
    """The meaning of the names in a JointState for a robot.

    Attributes:
        names: The names.
        number_of_positions: How many positions follow them.
        joints: The robot's joints that the message moves, mimic joints included, sorted.
        knows_a_joint: Whether a moving joint of the robot is among the names.
    """

    def __init__(self, robot: Description, prefix: str, cdr: bytes) -> None:
        names, after_names = _names_of(cdr)
        self.names = names
        self.number_of_positions = _COUNT.unpack_from(cdr, after_names)[0]
        self._head = cdr[_FRAME_ID : after_names + 4]
        begin = after_names + 4
        self._positions = begin + (4 - begin) % 8  # alignment counts from behind the encapsulation
        self._end = self._positions + 8 * self.number_of_positions
        moved = _moved_joints(robot, names) if len(names) == self.number_of_positions else []
        self.joints = tuple(joint.name for joint, _ in moved)
        self.knows_a_joint = any(
            name in robot.joints and robot.joints[name].moves for name in names
        )
        self._writer = FramesWriter(
            [
                Moving(prefix + joint.parent, prefix + joint.child, joint, *drive)
                for joint, drive in moved
            ]
        )

    def fits(self, cdr: bytes) -> bool:
        """Return True if a message has this layout, and all of its positions."""
        return cdr.startswith(self._head, _FRAME_ID) and len(cdr) >= self._end

    def transforms(self, cdr: bytes) -> bytes:
        """The TFMessage of a JointState with this layout, in CDR; stamps are the JointState's."""
        return self._writer.message(cdr, self._positions)

    def teach(self, relay: JointRelay) -> None:
        """Let native code answer messages with this layout."""
        frames: Any = self._writer.frames  # native ones, because the relay is native
        relay.add_layout(
            self._head, self._positions, self._end, frames, self.names, self.knows_a_joint
        )


class JointMessages:
    """Reads JointStates for one robot.

    Args:
        robot: The robot.
        prefix: Is put before the names of all frames.
    """

    def __init__(self, robot: Description, prefix: str = "") -> None:
        self._robot = robot
        self._prefix = prefix
        self._layouts: list[Layout] = []  # the latest one first

    def layout_of(self, cdr: bytes) -> Layout:
        """Return the layout of a JointState in CDR.

        Raises:
            CdrError: The bytes are not a JointState.
        """
        for number, layout in enumerate(self._layouts):
            if layout.fits(cdr):
                if number:
                    self._layouts.insert(0, self._layouts.pop(number))
                return layout
        try:
            layout = Layout(self._robot, self._prefix, cdr)
        except (struct.error, UnicodeDecodeError) as error:
            raise CdrError(f"malformed sensor_msgs/msg/JointState: {error}") from None
        if not layout.fits(cdr):
            raise CdrError("malformed sensor_msgs/msg/JointState: it ends within its positions")
        self._layouts.insert(0, layout)
        del self._layouts[_MOST_LAYOUTS:]
        return layout


def stamp_of(cdr: bytes) -> int:
    """Return the stamp of a message whose first field is a header, in nanoseconds."""
    seconds, nanoseconds = _STAMP.unpack_from(cdr, 4)
    return int(seconds) * 1_000_000_000 + int(nanoseconds)


def _names_of(cdr: bytes) -> tuple[tuple[str, ...], int]:
    """Return the names, and where the number of positions is."""
    if cdr[1:2] != b"\x01":
        raise struct.error("it is not in little-endian CDR")
    _, at = _string(cdr, _FRAME_ID)
    at += -at % 4
    (count,) = _COUNT.unpack_from(cdr, at)
    at += 4
    if count > len(cdr) // 4:  # each name takes four bytes at least
        raise struct.error("it ends within its names")
    names = []
    for _ in range(count):
        name, at = _string(cdr, at + -at % 4)
        names.append(name)
    return tuple(names), at + -at % 4


def _string(cdr: bytes, at: int) -> tuple[str, int]:
    (size,) = _COUNT.unpack_from(cdr, at)
    begin, end = at + 4, at + 4 + size
    if end > len(cdr):
        raise struct.error("it ends within a string")
    return cdr[begin:end].rstrip(b"\0").decode(), end


def _moved_joints(robot: Description, names: tuple[str, ...]) -> list[tuple[Joint, _Drive]]:
    """Return the moving joints that follow from these names, sorted, and what drives them."""
    drives: dict[str, _Drive | None] = {}
    for source, name in enumerate(names):
        drives.setdefault(name, _Drive(source, 1.0, 0.0))  # of equal names the first one counts
    found = []
    for joint in sorted(robot.joints.values(), key=lambda joint: joint.name):
        drive = _drive(robot, joint, drives) if joint.moves else None
        if drive is not None:
            found.append((joint, drive))
    return found


def _drive(robot: Description, joint: Joint, drives: dict[str, _Drive | None]) -> _Drive | None:
    """Return a joint's drive through all joints that it mimics; ``drives`` collects them."""
    chain = []
    name = joint.name
    while name not in drives:
        drives[name] = None  # if the chain returns to this joint, no joint drives it
        part = robot.joints.get(name)
        if part is None or part.mimic is None:
            break
        chain.append(part)
        name = part.mimic.joint
    drive = drives[name]
    for part in reversed(chain):
        assert part.mimic is not None, "a joint that follows none ends the chain"
        if drive is not None:
            factor, offset = part.mimic.multiplier, part.mimic.offset
            drive = _Drive(drive.source, factor * drive.factor, factor * drive.offset + offset)
        drives[part.name] = drive
    return drive
