"""A simulator and the nodes that drive it, in one process and in lock-step: reproducible."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from geometry_msgs.msg import Twist
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from turtlesim.model import TICK_NS
from turtlesim.testing.faults import FaultyTransforms
from turtlesim.testing.stage import Stage
from turtlesim.turtlesim_node import TurtlesimNode

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy.publisher import Publisher
    from turtlesim.model import TurtlePose
    from turtlesim.testing.faults import Fault


class Simulation(Stage):
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
        self._commands: dict[str, Publisher] = {}
        super().__init__()
        self._faulty = FaultyTransforms(self.wire.bus)
        try:
            self._begin()
        except BaseException:
            self.close()
            raise

    def _begin(self) -> None:
        self._faulty.listen()
        self.node = TurtlesimNode(headless=True)
        self.add(self.node)
        self._driver = Node("simulation", parameter_overrides=[])
        self.add(self._driver)
        self._clock = self._driver.create_publisher(Clock, "/clock", 1)
        self._publish_time()
        self.come_to_rest()

    def close(self) -> None:
        """Destroy all nodes, including added ones, and leave the domain."""
        self._faulty.close()
        super().close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

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
        self.come_to_rest()
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
        self.come_to_rest()

    def pose(self, turtle: str) -> TurtlePose:
        """Return a turtle's pose now.

        Raises:
            KeyError: No turtle has this name; the message lists the existing turtles.
        """
        pose = self.node.pose_of(turtle)
        if pose is None:
            raise KeyError(
                f"no turtle named {turtle!r}; the turtles are: "
                f"{', '.join(sorted(self.node.world.turtles)) or 'none'}"
            )
        return pose

    def distance(self, one: str, other: str) -> float:
        """Return the distance between two turtles [m]."""
        a, b = self.pose(one), self.pose(other)
        return math.hypot(a.x - b.x, a.y - b.y)

    # Faults

    def inject(self, fault: Fault) -> None:
        """Switch a fault of :mod:`turtlesim.testing.faults` on, in addition to the active ones."""
        self._faulty.faults.append(fault)
        fault.begin(self)

    def clear_faults(self) -> None:
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
            self.come_to_rest()

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
