"""The turtles and their world, bit for bit the turtlesim of ROS 2 Jazzy.

The model draws nothing, sends nothing and has no clock. :meth:`World.step` moves every turtle by
one tick and returns the results: a pose, the pixel under the colour sensor, pen strokes. The caller
decides how fast time passes.

Positions are metres in a field of 11.088889 m by 11.088889 m, origin in the lower left corner,
headings radians counter-clockwise from the x axis. As in the original the vertical axis points
*down* inside (``Turtle.y_down``) and the integration runs in double precision on it; both are
needed for equal bits. Strokes are in pixels of the original 500 x 500 image (45 pixels to the
metre, rows counted from the top).
"""

from __future__ import annotations

import math
from enum import Enum
from typing import NamedTuple

from turtlesim.physics import (
    COMMAND_LIFETIME_NS,
    FIELD_SIZE,
    IMAGE_SIZE,
    PIXELS_PER_METRE,
    TICK_NS,
    clamp,
    float32,
    move,
    normalize_angle,
    pixel_of,
    published,
    turn,
)

__all__ = [
    "COMMAND_LIFETIME_NS",
    "DEFAULT_PEN",
    "FIELD_SIZE",
    "IMAGE_SIZE",
    "PIXELS_PER_METRE",
    "ROTATION_SPEED",
    "ROTATION_TOLERANCE",
    "TICK_NS",
    "Pen",
    "Rotation",
    "RotationState",
    "Stroke",
    "Turtle",
    "TurtlePose",
    "TurtleTick",
    "World",
    "normalize_angle",
]

#: A rotation has arrived when the heading is this close to its goal [rad]; it turns at this speed
#: [rad/s].
ROTATION_TOLERANCE = 0.02
ROTATION_SPEED = 1.0


class Pen(NamedTuple):
    """Colour channels (0..255) and width, in pixels of the 500 x 500 image, of a line."""

    r: int
    g: int
    b: int
    width: int


# The original's.
DEFAULT_PEN = Pen(0xB3, 0xB8, 0xFF, 3)
#: The end time of a command whose first tick is still to come.
_NEW_COMMAND = -math.inf


class TurtlePose(NamedTuple):
    """Published state: position [m, y up], heading [rad], speed [m/s], turning rate [rad/s]."""

    x: float
    y: float
    theta: float
    linear_velocity: float
    angular_velocity: float


class Stroke(NamedTuple):
    """A straight pen line in pixels of the 500 x 500 image, from the old to the new place."""

    x0: float
    y0: float
    x1: float
    y1: float
    pen: Pen


class TurtleTick(NamedTuple):
    """The results of one tick of a turtle.

    Attributes:
        turtle: The turtle.
        pose: The new pose.
        teleport_strokes: Drawn before the colour sensor reads the pixel.
        sensor_pixel: Column and row of the pixel under the colour sensor.
        move_stroke: Drawn after the colour sensor has read the pixel; None when the pen is up or
            the turtle stands still.
        clamped_from: Where a wall stopped it, as ``(x, y_down)`` [m]; None when no wall did.
        rotation: The rotation to a goal, finished or not; None without a goal.
    """

    turtle: Turtle
    pose: TurtlePose
    teleport_strokes: list[Stroke]
    sensor_pixel: tuple[int, int]
    move_stroke: Stroke | None
    clamped_from: tuple[float, float] | None
    rotation: Rotation | None


class RotationState(Enum):
    """The progress of a rotation."""

    ACTIVE = "active"
    SUCCEEDED = "succeeded"
    CANCELED = "canceled"
    ABORTED = "aborted"


class Rotation:
    """The task of turning to an absolute heading.

    Attributes:
        goal: Heading asked for [rad], any finite number.
        delta: How far the turtle has turned so far, start minus present heading [rad].
        remaining: Angle left to turn, positive counter-clockwise [rad].
        state: See :class:`RotationState`.
        cancel_requested: Set to have the next tick end the rotation.
    """

    __slots__ = ("cancel_requested", "delta", "goal", "remaining", "start", "state")

    def __init__(self, goal: float, start: float) -> None:
        self.goal = goal
        self.start = start
        self.delta = 0.0
        self.remaining = 0.0
        self.state = RotationState.ACTIVE
        self.cancel_requested = False


class Turtle:
    """A turtle. The attributes are its state between two ticks, in the units of this module.

    Attributes:
        name: Name, unique in its world.
        x: Position to the right [m].
        y_down: Position downwards from the upper edge [m].
        theta: Heading [rad].
        forward: Commanded speed ahead [m/s].
        lateral: Commanded speed to the left [m/s]; stays 0 unless the world is holonomic.
        turning: Commanded turning rate [rad/s].
        pen: Colour and width of its line.
        pen_on: Whether it draws.
        rotation: The rotation being worked on, or None.
        command_ends_ns: When the velocity command is too old; minus infinity for one that came
            after the last tick, infinity once the turtle has stopped.
    """

    __slots__ = (
        "_teleports",
        "command_ends_ns",
        "forward",
        "lateral",
        "name",
        "pen",
        "pen_on",
        "rotation",
        "theta",
        "turning",
        "x",
        "y_down",
    )

    def __init__(self, name: str, x: float, y: float, theta: float) -> None:
        self.name = name
        self.x = x
        # The original subtracts two floats here, and computes in double precision from then on.
        self.y_down = float32(FIELD_SIZE - y)
        self.theta = theta
        self.pen = DEFAULT_PEN
        self.pen_on = True
        self.rotation: Rotation | None = None
        self._stop()
        self.command_ends_ns: float = 0
        self._teleports: list[tuple[bool, float, float, float]] = []

    @property
    def pose(self) -> TurtlePose:
        """The pose of the turtle, and the velocities of the last command."""
        state = (self.x, self.y_down, self.theta, self.forward, self.lateral, self.turning)
        return TurtlePose._make(published(state))

    @property
    def is_plain(self) -> bool:
        """True if the next tick only drives it: no teleport, no rotation to a goal."""
        return self.rotation is None and not self._teleports

    def drive(self, forward: float, lateral: float, turning: float) -> Rotation | None:
        """Take a velocity command; it holds for one second from the next tick on.

        Returns:
            The rotation that this command aborted, or None.
        """
        self.forward, self.lateral, self.turning = forward, lateral, turning
        self.command_ends_ns = _NEW_COMMAND
        return self._abort_rotation()

    def rotate_to(self, heading: float) -> tuple[Rotation, Rotation | None]:
        """Start turning to an absolute heading [rad].

        Returns:
            The new rotation, and the one that it aborted, if any.
        """
        aborted = self._abort_rotation()
        self.rotation = Rotation(heading, self.theta)
        return self.rotation, aborted

    def teleport_absolute(self, x: float, y: float, theta: float) -> None:
        """Move to (x, y) [m, y up] with heading theta [rad] at the next tick, within the field."""
        self._teleports.append((False, x, y, theta))

    def teleport_relative(self, linear: float, angular: float) -> None:
        """Turn by angular [rad], then jump ahead by linear [m], at the next tick."""
        self._teleports.append((True, linear, 0.0, angular))

    def set_pen(self, pen: Pen, *, off: bool) -> None:
        """Lift the pen and keep its colour, or put down a new one; width 0 draws one pixel."""
        self.pen_on = not off
        if not off:
            # As Qt does, which draws the original's lines.
            self.pen = pen if pen.width else pen._replace(width=1)

    def step(self, now_ns: int) -> TurtleTick:
        """Move by one tick; ``now_ns`` is only compared with the time of the last command."""
        # The order is the original's; poses and colours depend on it.
        self.age_command(now_ns)
        teleport_strokes = self.land() if self._teleports else []
        rotation = self.rotation
        if rotation is not None:
            self._rotate(rotation, now_ns)
        old_x, old_y = self.x, self.y_down
        clamped_from = self._move()
        x, y = self.x, self.y_down
        stroke = (
            self._stroke_from(old_x, old_y) if self.pen_on and (x != old_x or y != old_y) else None
        )
        return TurtleTick(
            self, self.pose, teleport_strokes, pixel_of(x, y), stroke, clamped_from, rotation
        )

    def land(self) -> list[Stroke]:
        """Carry out the teleports that came since the last tick; returns their lines."""
        teleports, self._teleports = self._teleports, []
        return [stroke for teleport in teleports if (stroke := self._teleport(*teleport))]

    def age_command(self, now_ns: int) -> None:
        """Note when a new command came, and stop when the last one is too old.

        Nothing is to be done up to the time ``command_ends_ns``.
        """
        if self.command_ends_ns == _NEW_COMMAND:
            self.command_ends_ns = now_ns + COMMAND_LIFETIME_NS
        elif now_ns > self.command_ends_ns:
            self._stop()
            self.command_ends_ns = math.inf

    def _move(self) -> tuple[float, float] | None:
        """Integrate one tick; the place outside of the field from which a wall moved it back."""
        self.theta = theta = turn(self.theta, self.turning)
        cos, sin = math.cos(theta), math.sin(theta)
        x, y = move(self.x, self.y_down, cos, sin, self.forward, self.lateral)
        self.x, self.y_down = x, y
        if 0.0 <= x <= FIELD_SIZE and 0.0 <= y <= FIELD_SIZE:
            return None
        self.x, self.y_down = clamp(x, y)
        return x, y

    def _stop(self) -> None:
        self.forward = self.lateral = self.turning = 0.0

    def _stroke_from(self, x: float, y_down: float) -> Stroke:
        scale = PIXELS_PER_METRE
        return Stroke(x * scale, y_down * scale, self.x * scale, self.y_down * scale, self.pen)

    def _teleport(self, relative: bool, first: float, y: float, angle: float) -> Stroke | None:
        old_x, old_y = self.x, self.y_down
        if relative:
            self.theta += angle
            self.x += math.cos(self.theta) * first
            self.y_down -= math.sin(self.theta) * first
        else:
            self.x = first
            # As in the original, only this side is limited here; the next move limits the others.
            self.y_down = max(0.0, FIELD_SIZE - y)
            self.theta = angle
        return self._stroke_from(old_x, old_y) if self.pen_on else None

    def _rotate(self, rotation: Rotation, now_ns: int) -> None:
        """Choose this tick's turning rate, in the original's mix of single and double precision."""
        if rotation.cancel_requested:
            self._end_rotation(rotation, RotationState.CANCELED)
            return
        goal = normalize_angle(rotation.goal)
        heading = float32(self.theta)
        rotation.remaining = normalize_angle(goal - heading)
        rotation.delta = normalize_angle(float32(rotation.start - self.theta))
        if abs(normalize_angle(heading - goal)) < ROTATION_TOLERANCE:
            self._end_rotation(rotation, RotationState.SUCCEEDED)
            return
        self.forward = self.lateral = 0.0
        self.turning = -ROTATION_SPEED if rotation.remaining < 0.0 else ROTATION_SPEED
        # Renewed at each tick, because a rotation may take longer than a command holds.
        self.command_ends_ns = now_ns + COMMAND_LIFETIME_NS

    def _end_rotation(self, rotation: Rotation, state: RotationState) -> None:
        rotation.state = state
        self.rotation = None
        self._stop()

    def _abort_rotation(self) -> Rotation | None:
        rotation, self.rotation = self.rotation, None
        if rotation is not None:
            rotation.state = RotationState.ABORTED
        return rotation


class World:
    """All turtles of one simulator, by name.

    Attributes:
        turtles: Name to turtle.
    """

    def __init__(self) -> None:
        self.turtles: dict[str, Turtle] = {}
        # Sorted after a change and not for each tick; None until it is needed.
        self._order: list[Turtle] | None = None
        self._named = 0

    def spawn(self, x: float, y: float, theta: float, name: str = "") -> Turtle | None:
        """Put a new turtle at (x, y) [m, y up] with heading theta [rad].

        Args:
            x: Single-precision number, as all three; outside of the field the first tick clamps it.
            y: See x.
            theta: See x.
            name: Empty for the next free ``turtle1``, ``turtle2``, ...

        Returns:
            The turtle, or None when the name is taken.
        """
        if not name:
            name = self._next_name()
        elif name in self.turtles:
            return None
        turtle = self.turtles[name] = Turtle(name, x, y, theta)
        self._order = None
        return turtle

    def spawn_centred(self) -> Turtle:
        """Put a turtle with the next free name into the middle, looking to the right."""
        middle = float32(FIELD_SIZE / 2.0)
        turtle = self.spawn(middle, middle, 0.0)
        assert turtle is not None
        return turtle

    def kill(self, name: str) -> Turtle | None:
        """Remove a turtle and return it, or None for an unknown name."""
        self._order = None
        return self.turtles.pop(name, None)

    def reset(self) -> None:
        """Remove all turtles; names start at ``turtle1`` again."""
        self.turtles.clear()
        self._order = None
        self._named = 0

    def in_order(self) -> list[Turtle]:
        """All turtles, sorted by name: the order in which they move and draw. Do not change it."""
        if self._order is None:
            self._order = [self.turtles[name] for name in sorted(self.turtles)]
        return self._order

    def step(self, now_ns: int) -> list[TurtleTick]:
        """Move every turtle by one tick, in the order of their names.

        Args:
            now_ns: The time of this tick, on any clock that only moves forward; commands grow old
                by it.
        """
        return [turtle.step(now_ns) for turtle in self.in_order()]

    def _next_name(self) -> str:
        while True:
            # As in the original, the count continues after a kill: no name is given twice until a
            # reset.
            self._named += 1
            name = f"turtle{self._named}"
            if name not in self.turtles:
                return name
