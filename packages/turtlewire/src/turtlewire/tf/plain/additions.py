"""The methods of the buffer that add transforms."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import CdrError
from turtlewire.tf.plain.checks import check_frames, nanoseconds, numbers
from turtlewire.tf.plain.failure import Refusal, Verdict
from turtlewire.tf.plain.tf_message import decode_tf_message
from turtlewire.tf.plain.tree import judge_names

if TYPE_CHECKING:
    from turtlewire.geometry.quaternions import Quaternion, Vector
    from turtlewire.tf.plain.shared_tree import SharedTree

__all__ = ["add_tf_message", "set_or_explain", "set_static_transform", "set_transform"]

_NO_TURN = (0.0, 0.0, 0.0, 1.0)


def set_transform(
    self: SharedTree,
    parent_frame: str,
    child_frame: str,
    stamp_ns: int,
    translation: Vector,
    rotation: Quaternion = _NO_TURN,
    *,
    sender: str = "default_authority",
) -> None:
    """Add one sample: the pose of child_frame in parent_frame at a time.

    Raises:
        InvalidTransformError: The sample is not added; the text is tf2's reason.
    """
    _add(self, parent_frame, child_frame, stamp_ns, translation, rotation, False, sender).check()


def set_static_transform(
    self: SharedTree,
    parent_frame: str,
    child_frame: str,
    translation: Vector,
    rotation: Quaternion = _NO_TURN,
    *,
    sender: str = "default_authority",
) -> None:
    """Add a pose of child_frame in parent_frame that holds at all times."""
    _add(self, parent_frame, child_frame, 0, translation, rotation, True, sender).check()


def set_or_explain(
    self: SharedTree,
    parent_frame: str,
    child_frame: str,
    stamp_ns: int,
    translation: Vector,
    rotation: Quaternion,
    static: bool,
    sender: str,
) -> str:
    """Return the reason instead of raising it, for buffers that log it."""
    return _add(
        self, parent_frame, child_frame, stamp_ns, translation, rotation, static, sender
    ).explain()


def _add(
    self: SharedTree,
    parent_frame: str,
    child_frame: str,
    stamp_ns: int,
    translation: Vector,
    rotation: Quaternion,
    static: bool,
    sender: str,
) -> Refusal:
    check_frames(parent_frame=parent_frame, child_frame=child_frame, sender=sender)
    (stamp_ns,) = nanoseconds(stamp_ns=stamp_ns)
    x, y, z = numbers("translation", translation, 3)
    qx, qy, qz, qw = numbers("rotation", rotation, 4)
    pose = (x, y, z, qx, qy, qz, qw)
    with self._lock:
        verdict = self._tree.set(parent_frame, child_frame, stamp_ns, pose, sender, static=static)
        if verdict is Verdict.ACCEPTED:
            self._end_waits()
    if verdict is Verdict.ACCEPTED:
        self._call_listeners()
    return Refusal(verdict, parent_frame, child_frame, stamp_ns, pose, sender)


def add_tf_message(
    self: SharedTree, cdr: bytes, *, static: bool = False, sender: str = "default_authority"
) -> int:
    """Add the transforms of one tf2_msgs/msg/TFMessage: CDR bytes with their 4-byte header.

    Returns:
        How many were accepted.

    Raises:
        CdrError: The bytes are malformed; nothing of them was added.
    """
    check_frames(sender=sender)
    try:
        transforms = decode_tf_message(bytes(memoryview(cdr)))
    except CdrError as error:
        with self._lock:
            fault = str(error).removeprefix("not a TFMessage: ")
            shown = self._tree.shown_senders.get(sender, sender)
            self._tree.refusals.add_malformed(fault, shown)
        raise
    accepted = 0
    with self._lock:
        for stamp, parent, child, pose in transforms:
            try:
                names = parent.decode(), child.decode()
            except UnicodeDecodeError:
                verdict = judge_names(_escaped(parent), _escaped(child))
                self._tree.refusals.add(
                    Refusal(verdict, _shown(parent), _shown(child), stamp, pose, sender)
                )
                continue
            verdict = self._tree.set(*names, stamp, pose, sender, static=static)
            accepted += verdict is Verdict.ACCEPTED
        if accepted:
            self._end_waits()
    if accepted:
        self._call_listeners()
    return accepted


def _escaped(name: bytes) -> str:
    """Return a name as the tree judges it: bytes that are not UTF-8 become surrogates."""
    return name.removeprefix(b"/").decode(errors="surrogateescape")


def _shown(name: bytes) -> str:
    return name.removeprefix(b"/").decode(errors="replace")
