"""The simulator's node, with the topics, services, parameters and texts of ROS 2's turtlesim."""

from __future__ import annotations

import contextlib
import itertools
import sys
from typing import TYPE_CHECKING, Any

import rclpy
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.clock_type import ClockType
from rclpy.exceptions import InvalidTopicNameException
from rclpy.executors import ExternalShutdownException
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty
from turtlesim.cpp_node import CppNode
from turtlesim.missing_turtles import MissingTurtles
from turtlesim.model import FIELD_SIZE, TICK_NS, World
from turtlesim.options import check_port, parse_options
from turtlesim.pace import FASTEST, Pace, hold
from turtlesim.page_actions import PageActions
from turtlesim.path import PathImage
from turtlesim.srv import Kill, Spawn
from turtlesim.turtle_endpoints import TurtleEndpoints, are_finite
from turtlewire.terminal.printable import printable, printable_lines

if TYPE_CHECKING:
    from rclpy.timer import Timer
    from turtlesim.crowd import Crowd
    from turtlesim.model import Pen, Turtle, TurtlePose
    from turtlesim.screen import Screen

#: From this number of turtles on, moving them together pays for loading NumPy.
_CROWD = 100
_BACKGROUND = {"r": ("Red", 0x45), "g": ("Green", 0x56), "b": ("Blue", 0xFF)}


class TurtlesimNode(CppNode):
    """A simulator, which moves its turtles every 16 ms of the node's clock.

    Args:
        headless: Whether to serve no page.
        speed: How many times faster than real time to run; the simulator then publishes ``/clock``
            itself. None runs in real time and publishes no clock.
        lan: Whether to serve the page to other devices of the network as well.
        options: Passed on to :class:`rclpy.node.Node`.

    Attributes:
        world: The model.
    """

    def __init__(
        self,
        *,
        headless: bool = False,
        speed: float | None = None,
        lan: bool = False,
        **options: Any,
    ) -> None:
        super().__init__("turtlesim", **options)
        self._declare_parameters()
        self.world = World()
        self._crowd: Crowd | None = None
        self._path = PathImage()
        self._endpoints_of: dict[str, TurtleEndpoints] = {}
        self._page = PageActions(self, self)
        self._screen: Screen | None = None
        self._pace = Pace(1.0 if speed is None else speed)
        self.create_service(Empty, "clear", self._on_clear)
        self.create_service(Empty, "reset", self._on_reset)
        self.create_service(Spawn, "spawn", self._on_spawn)
        self.create_service(Kill, "kill", self._on_kill)
        self.get_logger().info(
            f"Starting turtlesim with node name {self.get_fully_qualified_name()}"
        )
        self._missing = MissingTurtles(self, lambda: self.world.turtles, self._show_scene)
        self._add(self.world.spawn_centred())
        self.add_post_set_parameters_callback(lambda _: self._on_parameters_set())
        self.context.on_shutdown(self._on_shutdown)
        if not headless:
            self._open_screen(lan)
        if speed is None:
            self._timer = self.create_timer(TICK_NS / 1e9, self._tick_of_clock)
        else:
            self._timer = self._make_time()
            self._declare_speed()

    def destroy_node(self) -> None:
        """Leave the graph, and stop serving the page."""
        self._missing.close()
        if self._screen is not None:
            self._screen.close()
        super().destroy_node()

    def _on_shutdown(self) -> None:
        turtles = len(self.world.turtles)
        if turtles >= _CROWD:
            self.get_logger().info(
                f"Removing {turtles} turtles from the graph, which takes a few seconds"
            )

    def _declare_parameters(self) -> None:
        for channel, (name, default) in _BACKGROUND.items():
            descriptor = ParameterDescriptor(
                description=f"{name} channel of the background color",
                integer_range=[IntegerRange(from_value=0, to_value=255, step=1)],
            )
            self.declare_parameter(f"background_{channel}", default, descriptor)
        self.declare_parameter(
            "holonomic",
            False,
            ParameterDescriptor(description="If true, then turtles will be holonomic"),
        )

    def _declare_speed(self) -> None:
        """Declare the parameter ``speed``, which ROS 2's turtlesim does not have, at first use."""
        if self.has_parameter("speed"):
            return
        limits = FloatingPointRange(from_value=0.0, to_value=max(FASTEST, self._pace.speed))
        descriptor = ParameterDescriptor(
            description="Simulated seconds in a second; 0 pauses", floating_point_range=[limits]
        )
        self.declare_parameter("speed", self._pace.speed, descriptor)

    def _on_parameters_set(self) -> None:
        speed = self.get_parameter("speed").value if self.has_parameter("speed") else None
        if speed is not None and speed != self._pace.speed:
            self._pace.change(speed, self.get_clock().now().nanoseconds)
            self._timer.timer_period_ns = self._pace.period_ns
        self._show_scene()

    # Time

    def _make_time(self) -> Timer:
        """Tick faster than real time, and publish the time."""
        publisher = self.create_publisher(Clock, "/clock", 1)
        message = Clock()
        ticks = itertools.count(1)

        def tick() -> None:
            if self._pace.speed:
                now_ns = next(ticks) * TICK_NS
                message.clock.sec, message.clock.nanosec = divmod(now_ns, 1_000_000_000)
                publisher.publish(message)
                self._tick(now_ns)
            else:
                self._hold()

        # Not the node's clock, which follows the `/clock` that is published here.
        clock = rclpy.clock.Clock(clock_type=ClockType.STEADY_TIME)
        return self.create_timer(self._pace.period_ns / 1e9, tick, clock=clock)

    def _tick_of_clock(self) -> None:
        """Tick by the node's clock."""
        if self._pace.speed:
            self._tick(self._pace.tick(self.get_clock().now().nanoseconds))
        else:
            self._hold()

    def _hold(self) -> None:
        """Handle the pages' commands, and show the turtles during a pause."""
        self._page.carry_out()
        ticks = hold(self.world.in_order())
        for tick in ticks:
            for stroke in tick.teleport_strokes:
                self._path.draw(stroke)
        self._path.settle()
        if self._screen is not None:
            self._screen.show(ticks)

    def _tick(self, now_ns: int) -> None:
        self._page.carry_out()
        turtles = self.world.in_order()
        if len(turtles) >= _CROWD and all(turtle.is_plain for turtle in turtles):
            self._step_crowd(now_ns)
        else:
            self._step_each(now_ns)

    def _step_each(self, now_ns: int) -> None:
        ticks = self.world.step(now_ns)
        for tick in ticks:
            if tick.clamped_from is not None:
                self._warn_of_wall(*tick.clamped_from)
            for stroke in tick.teleport_strokes:
                self._path.draw(stroke)
            self._endpoints_of[tick.turtle.name].publish(tick, self._path)
            if tick.move_stroke is not None:
                self._path.draw(tick.move_stroke)
        self._path.settle()
        if self._screen is not None:
            self._screen.show(ticks)

    def _step_crowd(self, now_ns: int) -> None:
        """Step many turtles together; most of the tick's time then goes into messages."""
        if self._crowd is None:
            from turtlesim.crowd import Crowd

            self._crowd = Crowd()
        tick = self._crowd.step(self.world.in_order(), now_ns)
        for place in tick.clamped_from:
            self._warn_of_wall(*place)
        drawn = 0
        for k, turtle in enumerate(tick.turtles):
            endpoints = self._endpoints_of[turtle.name]
            if endpoints.pose_listeners:
                endpoints.publish_pose(tick.poses[k].tolist())
            if endpoints.color_listeners:  # it sees lines of earlier turtles
                before = int(tick.movers.searchsorted(k))
                self._path.draw_lines(tick.lines[drawn:before], tick.pens[drawn:before])
                drawn = before
                endpoints.publish_color(*self._path.colour_at(*tick.sensor_pixel(k)))
        self._path.draw_lines(tick.lines[drawn:], tick.pens[drawn:])
        if self._screen is not None:
            self._screen.show_crowd(tick)

    def _warn_of_wall(self, x: float, y_down: float) -> None:
        self.get_logger().warning(f"Oh no! I hit the wall! (Clamping from [x={x:f}, y={y_down:f}])")

    # Turtles

    def pose_of(self, name: str) -> TurtlePose | None:
        """Return a turtle's pose, for nodes of the same executor; None without such a turtle."""
        turtle = self.world.turtles.get(name)
        return None if turtle is None else turtle.pose

    def _add(self, turtle: Turtle) -> None:
        """Announce a turtle of the world.

        Raises:
            InvalidTopicNameException, ValueError: ROS does not allow its name; it has left the
                world again.
        """
        try:
            self._endpoints_of[turtle.name] = TurtleEndpoints(self, turtle, self._show_scene)
        except (InvalidTopicNameException, ValueError):
            self.world.kill(turtle.name)
            raise
        x, y = turtle.x, FIELD_SIZE - turtle.y_down
        self.get_logger().info(
            f"Spawning turtle [{turtle.name}] at x=[{x:f}], y=[{y:f}], theta=[{turtle.theta:f}]"
        )
        self._missing.forget(turtle.name)
        self._show_scene()

    def _remove(self, name: str) -> None:
        self._endpoints_of.pop(name).destroy()
        self._page.forget(name)

    def spawn(self, x: float, y: float, theta: float, name: str) -> str:
        """Add a turtle, and return its name, or an empty string after an error was logged."""
        if not are_finite(x, y, theta):
            self.get_logger().error(
                f"Cannot spawn a turtle at a pose that is not finite: x={x}, y={y}, theta={theta}"
            )
            return ""
        turtle = self.world.spawn(x, y, theta, name)
        if turtle is None:
            self.get_logger().error(f"A turtle named [{name}] already exists")
            return ""
        try:
            self._add(turtle)
        except (InvalidTopicNameException, ValueError) as error:
            self.get_logger().error(printable_lines(f"Cannot name a turtle [{name}]: {error}"))
            return ""
        return turtle.name

    def kill(self, name: str) -> None:
        """Remove a turtle, or log an error if the name is unknown."""
        if self.world.kill(name) is None:
            self.get_logger().error(
                printable(f"Tried to kill turtle [{name}], which does not exist")
            )
            return
        self._remove(name)
        self._show_scene()

    def clear(self) -> None:
        """Clear the drawing."""
        self.get_logger().info("Clearing turtlesim.")
        self._clear_drawing()

    def _clear_drawing(self) -> None:
        self._path.clear()
        if self._screen is not None:
            self._screen.clear()

    def reset(self) -> None:
        """Begin again with one turtle in the middle."""
        self.get_logger().info("Resetting turtlesim.")
        for name in list(self._endpoints_of):
            self._remove(name)
        self.world.reset()
        self._add(self.world.spawn_centred())
        self._clear_drawing()

    def set_pen(self, turtle: str, pen: Pen, *, off: bool) -> None:
        """Change a turtle's pen, or lift it; nothing if there is no such turtle."""
        if turtle in self.world.turtles:
            self.world.turtles[turtle].set_pen(pen, off=off)
            self._show_scene()

    def set_background(self, r: int, g: int, b: int) -> None:
        """Change the background by its parameters."""
        values = zip(_BACKGROUND, (r, g, b), strict=True)
        self.set_parameters(
            [Parameter(f"background_{channel}", value=value) for channel, value in values]
        )

    def set_speed(self, speed: float) -> None:
        """Change how fast the simulation goes, 0 for a pause, by its parameter."""
        self._declare_speed()
        self.set_parameters([Parameter("speed", value=speed)])

    # Services

    def _on_clear(self, _: Any, response: Any) -> Any:
        self.clear()
        return response

    def _on_reset(self, _: Any, response: Any) -> Any:
        self.reset()
        return response

    def _on_spawn(self, request: Any, response: Any) -> Any:
        response.name = self.spawn(request.x, request.y, request.theta, request.name)
        return response

    def _on_kill(self, request: Any, response: Any) -> Any:
        self.kill(request.name)
        return response

    # The page

    def _open_screen(self, lan: bool) -> None:
        from turtlesim.screen import Screen
        from turtlesim.transform_view import TransformView
        from turtlewire.web.desktop import open_browser
        from turtlewire.web.lan import invite

        transforms = TransformView(
            self.context.wire, self.get_namespace(), lambda: self.get_clock().now().nanoseconds
        )
        self._screen = Screen(self._scene(), self._page.add, transforms, lan=lan)
        self.get_logger().info(f"The field is shown at {self._screen.url}")
        if lan:
            invite(self._screen.url, self.get_logger().info)
        open_browser(self._screen.url)

    def show_on(self, screen: Any) -> None:
        """Show the turtles on a screen with the methods of `Screen`, without serving a page."""
        self._screen = screen
        self._show_scene()

    def _scene(self) -> Any:
        from turtlesim.picture import Scene, pen_of

        red, green, blue = (
            self.get_parameter(f"background_{channel}").value for channel in _BACKGROUND
        )
        turtles = self.world.in_order()
        return Scene(
            self.get_fully_qualified_name(),
            tuple([turtle.name for turtle in turtles]),
            (red, green, blue),
            self._missing.names,
            tuple([pen_of(turtle) for turtle in turtles]),
            self._pace.speed,
        )

    def _show_scene(self) -> None:
        if self._screen is not None:
            self._screen.set_scene(self._scene())


def main(args: list[str] | None = None) -> None:
    """Run the simulator until Ctrl-C."""
    options = parse_options(sys.argv if args is None else args)
    if not options.headless:
        check_port()
    rclpy.init(args=args)
    node = None
    # Around the shutdown as well, because Ctrl-C may also come then.
    with contextlib.suppress(KeyboardInterrupt, ExternalShutdownException):
        try:
            node = TurtlesimNode(headless=options.headless, speed=options.speed, lan=options.lan)
            rclpy.spin(node)
        finally:
            # Before the node: all endpoints go at once, which saves seconds with many turtles.
            rclpy.try_shutdown()
            if node is not None:
                node.destroy_node()


if __name__ == "__main__":
    main()
