"""The ROS side of one turtle: its topics, services and action."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Twist
from rclpy.event_handler import PublisherEventCallbacks
from turtlesim.model import Pen
from turtlesim.msg import Color, Pose
from turtlesim.rotate_action import RotateAction
from turtlesim.srv import SetPen, TeleportAbsolute, TeleportRelative

if TYPE_CHECKING:
    from rclpy.node import Node
    from turtlesim.model import Turtle, TurtleTick
    from turtlesim.path import PathImage

#: History depth of all topics of a turtle; reliable and volatile, as a mere depth says.
QUEUE_DEPTH = 7
#: Commands must fit into single precision, in which velocities are published.
_LARGEST = 3.4e38


class TurtleEndpoints:
    """Everything that ROS sees of a turtle; :meth:`destroy` takes it off the graph again.

    Attributes:
        pose_listeners: How many subscriptions its pose has. The middleware reports changes, because
            asking for each of a thousand turtles at each tick takes too long.
        color_listeners: How many subscriptions its colour sensor has.

    Raises (on construction):
        InvalidTopicNameException, ValueError: The turtle's name is not valid in a topic name.
    """

    def __init__(self, node: Node, turtle: Turtle, on_pen: Callable[[], None]) -> None:
        """Announce a turtle; ``on_pen`` is called when a service has changed its pen."""
        self._node = node
        self._turtle = turtle
        self._on_pen = on_pen
        name = turtle.name
        # A wrong name fails here, before any endpoint is made.
        node.resolve_topic_name(f"{name}/cmd_vel")
        self._cmd_vel = node.create_subscription(
            Twist, f"{name}/cmd_vel", self._on_cmd_vel, QUEUE_DEPTH
        )
        self.pose_listeners = self.color_listeners = 0
        self._pose_message = Pose()
        self._pose = node.create_publisher(
            Pose,
            f"{name}/pose",
            QUEUE_DEPTH,
            event_callbacks=PublisherEventCallbacks(matched=self._on_pose_matched),
        )
        self._color = node.create_publisher(
            Color,
            f"{name}/color_sensor",
            QUEUE_DEPTH,
            event_callbacks=PublisherEventCallbacks(matched=self._on_color_matched),
        )
        self._services = [
            node.create_service(SetPen, f"{name}/set_pen", self._on_set_pen),
            node.create_service(
                TeleportRelative, f"{name}/teleport_relative", self._on_teleport_relative
            ),
            node.create_service(
                TeleportAbsolute, f"{name}/teleport_absolute", self._on_teleport_absolute
            ),
        ]

        self._rotate = RotateAction(node, turtle)

    def publish(self, tick: TurtleTick, path: PathImage) -> None:
        """Send pose, colour and feedback; ``path`` does not have the tick's last stroke yet."""
        if tick.rotation is not None:
            self._rotate.report(tick.rotation)
        self.publish_pose(tick.pose)
        if self.color_listeners:
            self.publish_color(*path.colour_at(*tick.sensor_pixel))

    def publish_pose(self, pose: Sequence[float]) -> None:
        """Send a pose, given as the five fields of its message, if a node listens."""
        if self.pose_listeners:
            message = self._pose_message
            (
                message.x,
                message.y,
                message.theta,
                message.linear_velocity,
                message.angular_velocity,
            ) = pose
            self._pose.publish(message)

    def publish_color(self, r: int, g: int, b: int) -> None:
        """Send the reading of the colour sensor."""
        self._color.publish(Color(r=r, g=g, b=b))

    def destroy(self) -> None:
        """Leave the graph."""
        self._node.destroy_subscription(self._cmd_vel)
        self._node.destroy_publisher(self._pose)
        self._node.destroy_publisher(self._color)
        for service in self._services:
            self._node.destroy_service(service)
        self._rotate.destroy()

    def _on_pose_matched(self, info: Any) -> None:
        self.pose_listeners = info.current_count

    def _on_color_matched(self, info: Any) -> None:
        self.color_listeners = info.current_count

    def _on_cmd_vel(self, message: Any) -> None:
        forward, lateral, turning = message.linear.x, message.linear.y, message.angular.z
        if not are_finite(forward, lateral, turning):
            self._node.get_logger().warning(
                f"Ignored a velocity command for [{self._turtle.name}] that is not finite: "
                f"x={forward}, y={lateral}, angular z={turning}"
            )
            return
        holonomic = self._node.get_parameter("holonomic").value
        if self._turtle.drive(forward, lateral if holonomic else 0.0, turning):
            self._node.get_logger().warning(
                "Velocity command received during rotation goal. Aborting goal"
            )
            self._rotate.abort()

    def _on_set_pen(self, request: Any, response: Any) -> Any:
        self._turtle.set_pen(
            Pen(request.r, request.g, request.b, request.width), off=bool(request.off)
        )
        self._on_pen()
        return response

    def _on_teleport_relative(self, request: Any, response: Any) -> Any:
        if self._accepts_teleport(request.linear, request.angular):
            self._turtle.teleport_relative(request.linear, request.angular)
        return response

    def _on_teleport_absolute(self, request: Any, response: Any) -> Any:
        if self._accepts_teleport(request.x, request.y, request.theta):
            self._turtle.teleport_absolute(request.x, request.y, request.theta)
        return response

    def _accepts_teleport(self, *numbers: float) -> bool:
        if are_finite(*numbers):
            return True
        self._node.get_logger().error(
            f"Cannot teleport [{self._turtle.name}] to what is not finite: "
            f"{', '.join(map(str, numbers))}"
        )
        return False


def are_finite(*numbers: float) -> bool:
    """Return True if no number is NaN or too large for the arithmetic of a pose."""
    return all(abs(number) <= _LARGEST for number in numbers)  # also false for NaN
