"""A relay between two networks, and the names and frames that differ between its ends."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire import msg
from turtlewire.errors import CdrError, WireError
from turtlewire.tf.listener import STATIC_TOPIC, TOPIC, TYPE_NAME
from turtlewire.wake_up import WakeUp
from turtlewire.wire.report import warn_once

from .direction import Direction, Ways
from .side import Mark, Side

if TYPE_CHECKING:
    from .side import End


class FramePrefix:
    """Renames the frames of ``tf2_msgs/msg/TFMessage``.

    Args:
        prefix: The prefix, such as ``robot1/``.
    """

    def __init__(self, prefix: str) -> None:
        self._prefix = prefix

    def add(self, cdr: bytes) -> bytes | None:
        """Put the prefix in front of all frames."""
        return _renamed(cdr, lambda frame: self._prefix + frame.lstrip("/"))

    def remove(self, cdr: bytes) -> bytes | None:
        """Take the prefix away; transforms between other frames are left out.

        None if no transform is left.
        """

        def without(frame: str) -> str | None:
            inside = frame.startswith(self._prefix)
            return frame[len(self._prefix) :] if inside else None

        return _renamed(cdr, without)


def _renamed(cdr: bytes, rename: Callable[[str], str | None]) -> bytes | None:
    """Rename the frames of a message; transforms with a frame that gets no name are left out."""
    try:
        message: Any = msg.deserialize(msg.get_message(TYPE_NAME), cdr)
    except CdrError as error:
        warn_once("relay TFMessage", f"a message of transforms was not carried: {error}")
        return None
    kept = []
    for transform in message.transforms:
        parent, child = rename(transform.header.frame_id), rename(transform.child_frame_id)
        if parent is not None and child is not None:
            transform.header.frame_id, transform.child_frame_id = parent, child
            kept.append(transform)
    message.transforms = kept
    return msg.serialize(message) if kept else None


_TRANSFORMS = {TOPIC, STATIC_TOPIC}


class Renaming:
    """Puts names into a namespace on the way there, and takes them out on the way back.

    Args:
        namespace: The namespace at the far end, such as ``/robot1``; empty keeps all names.
        shares_transforms: Whether ``/tf`` and ``/tf_static`` keep their names, because a prefix
            tells the frames of robots apart.
        same_network: Whether both ends are the same network, so that names in the namespace are
            there already.
    """

    def __init__(self, namespace: str, *, shares_transforms: bool, same_network: bool) -> None:
        self._prefix = namespace.rstrip("/")
        self._shared = _TRANSFORMS if shares_transforms else set()
        self._same_network = same_network

    def there(self, name: str) -> str | None:
        """Return the name at the far end; None if it is not carried."""
        if name in self._shared:
            return name
        if self._same_network and name.startswith(f"{self._prefix}/"):
            return None
        return self._prefix + name

    def back(self, name: str) -> str | None:
        """Return the name at the near end; None if it is not carried."""
        if name in self._shared:
            return name
        if not name.startswith(f"{self._prefix}/"):
            return None
        near = name[len(self._prefix) :]
        return None if near in self._shared else near

    def node_there(self, full_name: str) -> str:
        """Return the name that a node of the near end has at the far end."""
        return self._prefix + full_name

    def node_back(self, full_name: str) -> str:
        """Return the name that a node of the far end has at the near end."""
        inside = full_name.startswith(f"{self._prefix}/")
        return full_name[len(self._prefix) :] if inside else full_name


_DISCOVERY_NS = 2_000_000_000


class Plan(NamedTuple):
    """The configuration of a relay.

    Attributes:
        near: The network whose names are put into the namespace.
        far: The other network.
        namespace: The namespace in the other network; empty keeps all names.
        frame_prefix: What is put in front of frames there; empty keeps them.
    """

    near: End
    far: End
    namespace: str = ""
    frame_prefix: str = ""


class Relay:
    """Carries topics, services and actions between two networks until it is closed.

    Args:
        plan: What to do.
        say: Gets a line for each thing that is carried.
    """

    def __init__(self, plan: Plan, say: Callable[[str], None]) -> None:
        self._say = say
        self._changed = WakeUp()
        self._ended = False
        self._stands_by = False
        self._mark = Mark((plan.namespace, plan.frame_prefix))
        self._near = Side(plan.near, self._mark)
        try:
            self._far = Side(plan.far, self._mark)
        except WireError:
            self._near.close()
            raise
        there, back = _ways(plan)
        self._directions = (
            Direction(self._near, self._far, there, say),
            Direction(self._far, self._near, back, say),
        )

    def run(self) -> None:
        """Carry until :meth:`end` is called; on the main thread, which a signal can interrupt."""
        sides = self._near, self._far
        for side in sides:
            side.graph.hurry()
            side.graph.wait_for(side.graph.is_complete, _DISCOVERY_NS)
        for side in sides:
            side.graph.add_listener(self._changed.set)
        while not self._ended:
            deadline = self._update()
            self._changed.wait(None if deadline is None else deadline - time.monotonic())

    def end(self) -> None:
        """Let :meth:`run` return. Safe in a signal handler."""
        self._ended = True
        self._changed.set()

    def _update(self) -> float | None:
        """Follow the graphs; return when to look again (monotonic seconds), or None."""
        near, far = self._near.look(), self._far.look()
        if self._mark.elder(near.nodes, far.nodes):
            self._stand_by()
            return None
        self._stands_by = False
        there, back = self._directions
        deadlines = near.until, far.until, there.update(near, far), back.update(far, near)
        self._far.keep_nodes(there.nodes)
        self._near.keep_nodes(back.nodes)
        return min(filter(None, deadlines), default=None)

    def _stand_by(self) -> None:
        """Carry nothing while another relay carries the same: each message would come twice."""
        if self._stands_by:
            return
        self._stands_by = True
        for direction in self._directions:
            direction.close()
        self._far.keep_nodes(set())
        self._near.keep_nodes(set())
        self._say("another relay carries the same: this one waits for its end")

    def close(self) -> None:
        """Leave both networks."""
        for direction in self._directions:
            direction.close()
        self._near.close()
        self._far.close()


def _ways(plan: Plan) -> tuple[Ways, Ways]:
    """Return what changes on the way there, and on the way back."""
    renaming = Renaming(
        plan.namespace,
        shares_transforms=bool(plan.frame_prefix),
        same_network=plan.near == plan.far,
    )
    frames = FramePrefix(plan.frame_prefix) if plan.frame_prefix else None
    add, remove = (frames.add, frames.remove) if frames else (None, None)
    there = Ways(renaming.there, renaming.back, renaming.node_there, add)
    return there, Ways(renaming.back, renaming.there, renaming.node_back, remove)
