"""A relay between two networks."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.errors import WireError
from turtlewire.wake_up import WakeUp

from .direction import Direction, Ways
from .marks import Mark
from .renaming import FramePrefix, Renaming
from .side import Side

if TYPE_CHECKING:
    from collections.abc import Callable

    from .ends import End

__all__ = ["Plan", "Relay"]

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
