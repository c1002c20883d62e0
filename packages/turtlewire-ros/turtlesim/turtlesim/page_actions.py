"""Carries out the commands of pages, always at the start of a tick."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from geometry_msgs.msg import Twist
from rclpy.action import ActionClient
from turtlesim import page_commands
from turtlesim.action import RotateAbsolute
from turtlesim.model import Pen
from turtlesim.turtle_endpoints import QUEUE_DEPTH

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.publisher import Publisher
    from rclpy.task import Future
    from turtlesim.model import World


class Simulator(Protocol):
    """The objects that pages can change."""

    world: World

    def spawn(self, x: float, y: float, theta: float, name: str) -> str:
        """Add a turtle."""
        ...

    def kill(self, name: str) -> None:
        """Remove a turtle."""
        ...

    def set_background(self, r: int, g: int, b: int) -> None:
        """Change the field's colour."""
        ...

    def set_pen(self, turtle: str, pen: Pen, *, off: bool) -> None:
        """Change a turtle's pen, or lift it."""
        ...

    def set_speed(self, speed: float) -> None:
        """Go faster, slower or not at all."""
        ...

    def clear(self) -> None:
        """Wipe the picture."""
        ...

    def reset(self) -> None:
        """Begin again."""
        ...


class PageActions:
    """Keeps the commands of the pages until the next tick, and carries them out.

    Velocity commands and rotations travel as messages and goals, so that other nodes can listen to
    them. Everything but :meth:`add` is for the executor's thread.

    Args:
        node: The simulator's node, whose publishers and action clients are used.
        simulator: What else the pages change.
    """

    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._node = node
        self._simulator = simulator
        # `append` and `popleft` of a deque need no lock.
        self._commands: deque[page_commands.Command] = deque()
        self._publishers: dict[str, Publisher] = {}
        self._rotations = _PageRotations(node)
        self._actions: dict[type, Callable[[Any], object]] = {
            page_commands.Drive: self._drive,
            page_commands.Rotate: self._rotate,
            page_commands.Cancel: lambda command: self._rotations.cancel(command.turtle),
            page_commands.Teleport: self._teleport,
            page_commands.Spawn: lambda command: simulator.spawn(*command),
            page_commands.Kill: lambda command: simulator.kill(command.turtle),
            page_commands.PenChange: self._set_pen,
            page_commands.Background: lambda command: simulator.set_background(*command),
            page_commands.Speed: lambda command: simulator.set_speed(command.factor),
            page_commands.Clear: lambda _: simulator.clear(),
            page_commands.Reset: lambda _: simulator.reset(),
        }

    def add(self, command: page_commands.Command) -> None:
        """Keep a command for the next tick. Callable from any thread."""
        self._commands.append(command)

    def carry_out(self) -> None:
        """Carry out the commands; the ones that are not possible yet wait for a later tick."""
        # Only the commands that are queued now, because some queue themselves again.
        for _ in range(len(self._commands)):
            command = self._commands.popleft()
            self._actions[type(command)](command)

    def forget(self, turtle: str) -> None:
        """Close the publishers and clients of a turtle that was removed."""
        self._rotations.forget(turtle)
        publisher = self._publishers.pop(turtle, None)
        if publisher is not None:
            self._node.destroy_publisher(publisher)

    def _drive(self, command: page_commands.Drive) -> None:
        name = command.turtle
        if name not in self._simulator.world.turtles:
            return
        publisher = self._publishers.get(name)
        if publisher is None:
            publisher = self._node.create_publisher(Twist, f"{name}/cmd_vel", QUEUE_DEPTH)
            self._publishers[name] = publisher
        if not publisher.get_subscription_count():  # the simulator's own is not discovered yet
            self._commands.append(command)
            return
        message = Twist()
        message.linear.x = command.linear
        message.angular.z = command.angular
        publisher.publish(message)

    def _rotate(self, command: page_commands.Rotate) -> None:
        name, theta = command
        if name in self._simulator.world.turtles and not self._rotations.rotate(name, theta):
            self._commands.append(command)

    def _set_pen(self, command: page_commands.PenChange) -> None:
        turtle, r, g, b, width, off = command
        self._simulator.set_pen(turtle, Pen(r, g, b, width), off=off)

    def _teleport(self, command: page_commands.Teleport) -> None:
        turtle = self._simulator.world.turtles.get(command.turtle)
        if turtle is not None:
            turtle.teleport_absolute(command.x, command.y, command.theta)


class _PageRotations:
    """Clients of the action ``rotate_absolute``, one for each turtle that the page has turned.

    Not thread-safe: for the executor's thread.

    Args:
        node: The simulator's node, whose clients they are.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, ActionClient] = {}
        self._goals: dict[str, Future] = {}

    def rotate(self, turtle: str, theta: float) -> bool:
        """Send a goal; False if the client has not found the action yet: try again later."""
        client = self._clients.get(turtle)
        if client is None:
            client = self._clients[turtle] = ActionClient(
                self._node, RotateAbsolute, f"{turtle}/rotate_absolute"
            )
        if not client.server_is_ready():
            return False
        self._goals[turtle] = client.send_goal_async(RotateAbsolute.Goal(theta=theta))
        return True

    def cancel(self, turtle: str) -> None:
        """Cancel the last goal, if it was accepted; one that has ended stays as it is."""
        goal = self._goals.get(turtle)
        if goal is not None and goal.done() and goal.result().accepted:
            goal.result().cancel_goal_async()

    def forget(self, turtle: str) -> None:
        """Close the client of a turtle that is gone."""
        self._goals.pop(turtle, None)
        client = self._clients.pop(turtle, None)
        if client is not None:
            client.destroy()
