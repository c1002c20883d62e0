"""Which turtles others reckon with although they do not exist: somebody listens to their pose, or sends them commands."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from turtlesim.msg import Color, Pose
from turtlewire.msg import type_name

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

    from rclpy.node import Node
    from turtlewire.wire.base import EndpointInfo

__all__ = ["MissingTurtles", "find_missing"]

#: How long a turtle must be missing before anybody is told: most programs spawn theirs right after
#: they start [s].
_PATIENCE_S = 2.0
#: Among more turtles than this nobody misses one; and to look at the endpoints of so many would
#: hold the simulator up.
_MOST_TURTLES = 200
#: Only the simulator serves these, so that who subscribes to one waits for a turtle.
_TURTLE_TOPICS = {"pose": type_name(Pose), "color_sensor": type_name(Color)}


class MissingTurtles:
    """Watches the graph, on its changes only.

    Attributes:
        names: The turtles that are missing at the moment, as far as is known.
    """

    def __init__(
        self, node: Node, turtles: Callable[[], Collection[str]], on_change: Callable[[], None]
    ) -> None:
        """Start watching.

        Args:
            node: The simulator's node; its namespace is where turtles are looked for.
            turtles: Gives the names of the turtles that exist.
            on_change: Called on the executor after :attr:`names` changed.
        """
        self.names: tuple[str, ...] = ()
        self._node = node
        self._turtles = turtles
        self._on_change = on_change
        self._patience = node.create_timer(_PATIENCE_S, self._look)
        self._changed = node.create_guard_condition(self._begin_to_wait)
        self._graph = node.context.wire.graph
        self._stop_listening = self._graph.add_listener(self._changed.trigger)

    def close(self) -> None:
        """Watch no longer."""
        self._stop_listening()

    def forget(self, name: str) -> None:
        """The turtle is there now."""
        self.names = tuple(missing for missing in self.names if missing != name)

    def _begin_to_wait(self) -> None:
        if self._patience.is_canceled():
            self._patience.reset()

    def _look(self) -> None:
        self._patience.cancel()
        turtles = self._turtles()
        is_crowd = len(turtles) > _MOST_TURTLES
        names = (
            ()
            if is_crowd
            else find_missing(self._graph.endpoints(), self._node.get_namespace(), turtles)
        )
        if names != self.names:
            self.names = names
            self._on_change()


def find_missing(
    endpoints: Iterable[EndpointInfo], namespace: str, turtles: Iterable[str]
) -> tuple[str, ...]:
    """Names of turtles in ``namespace`` that an endpoint reckons with, that no simulator serves, and that are not in ``turtles``."""
    pattern = re.compile(re.escape(namespace.rstrip("/")) + r"/([^/]+)/(pose|color_sensor|cmd_vel)")
    wanted: set[str] = set()
    served = set(turtles)
    for endpoint in endpoints:
        match = pattern.fullmatch(endpoint.topic)
        if match is None:
            continue
        name, topic = match.groups()
        is_turtle_topic = endpoint.type_name == _TURTLE_TOPICS.get(topic)
        if is_turtle_topic:
            (served if endpoint.kind == "publisher" else wanted).add(name)
        elif topic == "cmd_vel" and re.fullmatch(
            r"turtle\d+", name
        ):  # cmd_vel alone may be any robot's
            (wanted if endpoint.kind == "publisher" else served).add(name)
    return tuple(sorted(wanted - served))
