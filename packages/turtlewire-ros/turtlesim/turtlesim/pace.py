"""The speed of the simulation, and the page's updates during a pause."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from turtlesim.model import TurtleTick
from turtlesim.physics import TICK_NS, pixel_of

if TYPE_CHECKING:
    from turtlesim.model import Turtle

#: The highest speed that can be set.
FASTEST = 1000.0


class Pace:
    """Simulated time, and how often it ticks.

    At the speed 1 it is that of a clock, as the original's. At another one it advances by a tick at
    a time, so that turtles go as far also when the computer cannot tick so often.

    Args:
        speed: Simulated seconds in a second of the clock; 0 in a pause.

    Attributes:
        speed: The same, now.
    """

    def __init__(self, speed: float = 1.0) -> None:
        self.speed = speed
        self._clock_ns = self._simulated_ns = 0

    @property
    def period_ns(self) -> int:
        """Time of the clock between two ticks; in a pause, the time between two looks."""
        return round(TICK_NS / self.speed) if self.speed else 2 * TICK_NS

    def change(self, speed: float, clock_ns: int) -> None:
        """Go on at another speed, when the clock shows ``clock_ns``."""
        if self.speed == 1.0:
            self._simulated_ns += clock_ns - self._clock_ns
        self.speed, self._clock_ns = speed, clock_ns

    def tick(self, clock_ns: int) -> int:
        """Return the simulated time of the next tick, for which the clock shows ``clock_ns``."""
        self._simulated_ns += clock_ns - self._clock_ns if self.speed == 1.0 else TICK_NS
        self._clock_ns = clock_ns
        return self._simulated_ns


def hold(turtles: Iterable[Turtle]) -> list[TurtleTick]:
    """Return the turtles' ticks in a pause: still, except for teleports."""
    ticks = []
    for turtle in turtles:
        strokes = turtle.land()
        sensor = pixel_of(turtle.x, turtle.y_down)
        ticks.append(TurtleTick(turtle, turtle.pose, strokes, sensor, None, None, None))
    return ticks
