"""Finds turtles whose topics have publishers or subscriptions, but that were never spawned."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable
from typing import TYPE_CHECKING

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from turtlesim.msg import Color, Pose
from turtlesim.srv import Spawn
from turtlewire.msg import type_name

if TYPE_CHECKING:
    from rclpy.node import Node
    from turtlewire.wire.base import EndpointInfo

#: How long a turtle must be missing before the first hint: most programs spawn theirs right after
#: they start [s].
_PATIENCE_S = 2.0
#: Time between two hints: the lines of a node that waits push the last one off the screen [s].
_REMINDER_S = 10.0
#: With more turtles than this there are no hints: checking the endpoints of that many turtles
#: would delay the simulator.
_MOST_TURTLES = 200
#: Only the simulator publishes these, so a node that subscribes to one waits for a turtle.
_TURTLE_TOPICS = {"pose": type_name(Pose), "color_sensor": type_name(Color)}


class MissingTurtles:
    """Looks at the graph when it changes, and logs how to spawn a missing turtle until it is there.

    Attributes:
        names: The turtles that were missing at the last look.
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
        real_time = Clock(clock_type=ClockType.STEADY_TIME)
        self._patience = node.create_timer(_PATIENCE_S, self._look, clock=real_time)
        self._reminder = node.create_timer(
            _REMINDER_S, self._remind, clock=real_time, autostart=False
        )
        self._changed = node.create_guard_condition(self._begin_to_wait)
        self._graph = node.context.wire.graph
        self._stop_listening = self._graph.add_listener(self._changed.trigger)

    def close(self) -> None:
        """Stop watching."""
        self._stop_listening()

    def forget(self, name: str) -> None:
        """Note that the turtle exists now."""
        self._set_names(tuple(missing for missing in self.names if missing != name))

    def hint(self, name: str) -> str:
        """Return the command that spawns a missing turtle."""
        service = self._node.resolve_service_name("spawn")
        request = f"{{x: 4.0, y: 2.0, theta: 0.0, name: '{name}'}}"
        return (
            f"A node waits for {name}, and there is no turtle with this name. "
            f'To add it, type: ros2 service call {service} {type_name(Spawn)} "{request}"'
        )

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
            self._log_hints(set(names) - set(self.names))
            self._set_names(names)
            self._on_change()

    def _set_names(self, names: tuple[str, ...]) -> None:
        self.names = names
        if not names:
            self._reminder.cancel()
        elif self._reminder.is_canceled():
            self._reminder.reset()

    def _remind(self) -> None:
        self._log_hints(self.names)

    def _log_hints(self, names: Iterable[str]) -> None:
        for name in sorted(names):
            self._node.get_logger().info(self.hint(name))


def find_missing(
    endpoints: Iterable[EndpointInfo], namespace: str, turtles: Iterable[str]
) -> tuple[str, ...]:
    """Return the names of turtles in ``namespace`` that endpoints refer to and that do not exist.

    Args:
        endpoints: The graph's publishers and subscriptions.
        namespace: The simulator's namespace.
        turtles: Turtles that exist; other simulators' are known by their publishers.
    """
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
        # A topic `cmd_vel` alone may be any robot's.
        elif topic == "cmd_vel" and re.fullmatch(r"turtle\d+", name):
            (wanted if endpoint.kind == "publisher" else served).add(name)
    return tuple(sorted(wanted - served))
