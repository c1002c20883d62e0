"""A simulator and the nodes that drive it, in one process and in lock-step: reproducible."""

from __future__ import annotations

import contextlib
import json
import math
import os
from collections import deque
from typing import TYPE_CHECKING

import rclpy
from geometry_msgs.msg import Twist
from rclpy.arguments import Arguments
from rclpy.executors import SingleThreadedExecutor, TimeoutException
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from turtlesim.model import TICK_NS
from turtlesim.testing.faults import FaultyTransforms
from turtlesim.testing.programs import nodes_of, rclpy_in_step
from turtlesim.turtlesim_node import TurtlesimNode
from turtlewire.wire.local.context import LocalContext

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from typing_extensions import Self

    from rclpy.publisher import Publisher
    from turtlesim.model import Pose
    from turtlesim.testing.faults import Fault

__all__ = ["Simulation"]

_MIDDLEWARE = "RMW_IMPLEMENTATION"
#: A node that publishes to itself for ever would never come to rest within a tick.
_MOST_CALLBACKS_IN_A_TICK = 100_000


class Simulation:
    """A simulator without a page, on the ``local`` middleware, with its clock on ``/clock``.

    Time moves only in :meth:`step` and the ``run`` methods, by 16 ms a tick, and not before every
    callback of the tick before has run. All nodes made while it is open follow its clock
    (``use_sim_time``). Use it as a context manager; one at a time in a process.

    Args:
        begin: Simulated time at the start [s].

    Attributes:
        node: The simulator's node.
        now: Simulated time [s].
    """

    def __init__(self, *, begin: float = 0.0) -> None:
        self._ticks = round(begin * 1e9 / TICK_NS)
        self.now = self._ticks * TICK_NS / 1e9
        self._nodes: list[Node] = []
        self._commands: dict[str, Publisher] = {}
        self._reader = _ReaderInStep()
        with _middleware_of_this_process():
            rclpy.init(args=["--ros-args", *_as_arguments({})])
        wire = rclpy.get_default_context().wire
        assert isinstance(wire, LocalContext)
        self._wire, self._faulty = wire, FaultyTransforms(wire.bus)
        self._executor = SingleThreadedExecutor()
        try:
            self._begin()
        except BaseException:
            self.close()
            raise

    def _begin(self) -> None:
        self._wire.replace_reader(self._reader)
        self._faulty.listen()
        self.node = TurtlesimNode(headless=True)
        self.add(self.node)
        self._driver = Node("simulation", parameter_overrides=[])
        self.add(self._driver)
        self._clock = self._driver.create_publisher(Clock, "/clock", 1)
        self._publish_time()
        self._come_to_rest()

    def close(self) -> None:
        """Destroy all nodes, those that were added too, and leave the domain."""
        for node in reversed(self._nodes):
            node.destroy_node()
        self._faulty.close()
        self._executor.shutdown()
        rclpy.try_shutdown()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def add(self, node: Node) -> Node:
        """Let a node take part; it is destroyed at the end. Returns the node."""
        self._nodes.append(node)
        self._executor.add_node(node)
        return node

    def start(self, make_node: Callable[[], Node], **parameters: object) -> Node:
        """Make a node with parameters, as a launch file would start it, and let it take part.

        Args:
            make_node: The node's class, or any function that makes it.
            parameters: Initial values of the node's parameters; ``name`` gives the node another
                name.
        """
        with self._arguments(parameters):
            return self.add(make_node())

    def start_program(
        self, main: Callable[[], object], *arguments: str, **parameters: object
    ) -> list[Node]:
        """Run the ``main`` of a node's file as a launch file would, and let its nodes take part.

        It runs up to ``rclpy.spin``. From then on the simulation spins.

        Args:
            main: The program's entry point.
            arguments: Its command line.
            parameters: As in :meth:`start`.

        Returns:
            Its nodes.

        Raises:
            ProgramError: It ended without spinning, or called a function that blocks.
        """
        with self._arguments(parameters), rclpy_in_step():
            nodes = [self.add(node) for node in nodes_of(main, arguments)]
        self._come_to_rest()
        return nodes

    @contextlib.contextmanager
    def _arguments(self, parameters: dict[str, object]) -> Iterator[None]:
        """Give nodes that are made inside these parameters."""
        context = self._driver.context
        outer, context._arguments = (
            context.arguments,
            Arguments.parse_global(["--ros-args", *_as_arguments(parameters)]),
        )
        try:
            yield
        finally:
            context._arguments = outer

    def remove(self, node: Node) -> None:
        """End a node before the simulation ends."""
        self._nodes.remove(node)
        node.destroy_node()
        self._come_to_rest()

    # Turtles

    def spawn(self, name: str = "", *, x: float, y: float, theta: float = 0.0) -> str:
        """Add a turtle at (x, y) [m] with heading theta [rad], and return its name.

        Raises:
            ValueError: The name is taken or impossible.
        """
        given = self.node.spawn(x, y, theta, name)
        if not given:
            raise ValueError(
                f"cannot spawn a turtle named {name!r} at x={x}, y={y}, theta={theta}: see the log"
            )
        self._come_to_rest()
        return given

    def drive(self, turtle: str, linear: float = 0.0, angular: float = 0.0) -> None:
        """Send one velocity command [m/s, rad/s], good for a second, as any other node would."""
        publisher = self._commands.get(turtle)
        if publisher is None:
            publisher = self._commands[turtle] = self._driver.create_publisher(
                Twist, f"/{turtle}/cmd_vel", 10
            )
        message = Twist()
        message.linear.x, message.angular.z = float(linear), float(angular)
        publisher.publish(message)
        self._come_to_rest()

    def pose(self, turtle: str) -> Pose:
        """Where a turtle is at this moment.

        Raises:
            KeyError: There is no turtle of that name; the text lists those there are.
        """
        pose = self.node.pose_of(turtle)
        if pose is None:
            raise KeyError(
                f"no turtle named {turtle!r}; there are: "
                f"{', '.join(sorted(self.node.world.turtles)) or 'none'}"
            )
        return pose

    def distance(self, one: str, other: str) -> float:
        """Between two turtles [m]."""
        a, b = self.pose(one), self.pose(other)
        return math.hypot(a.x - b.x, a.y - b.y)

    # Faults

    def inject(self, fault: Fault) -> None:
        """Switch a fault of :mod:`turtlesim.testing.faults` on, beside those that are on."""
        self._faulty.faults.append(fault)
        fault.begin(self)

    def mend(self) -> None:
        """Switch all faults off; transforms that are delayed still arrive."""
        faults, self._faulty.faults = self._faulty.faults, []
        for fault in faults:
            fault.end(self)

    # Time

    def step(self, ticks: int = 1) -> None:
        """Let ticks of 16 ms pass."""
        for _ in range(ticks):
            self._ticks += 1
            self.now = self._ticks * TICK_NS / 1e9
            self._publish_time()
            self._faulty.advance(self.now)
            self._come_to_rest()

    def run(self, seconds: float) -> None:
        """Let simulated time pass, rounded to whole ticks."""
        self.step(round(seconds * 1e9 / TICK_NS))

    def run_until(self, condition: Callable[[], bool], *, within: float) -> bool:
        """Let time pass until ``condition()``, tested after each tick, is true.

        Returns:
            Whether it became true.
        """
        for _ in range(round(within * 1e9 / TICK_NS)):
            if condition():
                return True
            self.step()
        return condition()

    def _publish_time(self) -> None:
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(self._ticks * TICK_NS, 1_000_000_000)
        self._clock.publish(message)

    def _come_to_rest(self) -> None:
        """Run callbacks until none is left: all that this moment brings about has happened then."""
        for _ in range(_MOST_CALLBACKS_IN_A_TICK):
            self._reader.run()
            try:
                ready = self._executor._rclpy_scheduler.next(0)
            except TimeoutException:
                return
            self._executor._rclpy_scheduler.run(*ready)
        raise RuntimeError(
            f"the nodes ran {_MOST_CALLBACKS_IN_A_TICK} callbacks at t={self.now:.3f} s "
            "and did not come to rest"
        )


class _ReaderInStep:
    """Replaces the middleware's reader thread, which feeds TF listeners, between callbacks."""

    def __init__(self) -> None:
        self._work: deque[Callable[[], None]] = deque()

    def submit(self, work: Callable[[], None]) -> None:
        """Have it done before the next callback."""
        self._work.append(work)

    def run(self) -> None:
        """Do all there is."""
        while self._work:
            self._work.popleft()()

    def close(self) -> None:
        """Drop the rest."""
        self._work.clear()


@contextlib.contextmanager
def _middleware_of_this_process() -> Iterator[None]:
    """Have `local` chosen, and leave the environment as it was."""
    before = os.environ.get(_MIDDLEWARE)
    os.environ[_MIDDLEWARE] = "local"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_MIDDLEWARE]
        else:
            os.environ[_MIDDLEWARE] = before


def _as_arguments(parameters: dict[str, object]) -> list[str]:
    """The arguments after ``--ros-args`` that set these parameters and simulated time."""
    name = parameters.pop("name", None)
    renamed = [] if name is None else ["-r", f"__node:={name}"]
    values = {"use_sim_time": True, **parameters}
    return renamed + [
        part for key, value in values.items() for part in ("-p", f"{key}:={json.dumps(value)}")
    ]
