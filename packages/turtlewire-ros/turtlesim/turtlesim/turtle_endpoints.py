"""The ROS side of one turtle: its topics, services and action."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Twist
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.event_handler import PublisherEventCallbacks
from rclpy.task import Future
from turtlesim.action import RotateAbsolute
from turtlesim.model import Pen, RotationState
from turtlesim.msg import Color, Pose
from turtlesim.srv import SetPen, TeleportAbsolute, TeleportRelative

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle
    from rclpy.node import Node
    from turtlesim.model import Rotation, Turtle, TurtleTick
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


class _Goal:
    """A goal, its rotation, and the future that its execution awaits."""

    def __init__(self, handle: ServerGoalHandle, rotation: Rotation) -> None:
        self.handle = handle
        self.rotation = rotation
        self.ended = Future()


class RotateAction:
    """Serves the action ``rotate_absolute`` of a turtle. Not thread-safe.

    The simulator calls :meth:`report` at each tick.
    """

    def __init__(self, node: Node, turtle: Turtle) -> None:
        self._node = node
        self._turtle = turtle
        self._goal: _Goal | None = None
        self._server = ActionServer(
            node,
            RotateAbsolute,
            f"{turtle.name}/rotate_absolute",
            self._execute,
            goal_callback=self._on_goal,
            cancel_callback=self._on_cancel,
        )

    def report(self, rotation: Rotation) -> None:
        """Send feedback on the goal of ``rotation`` after a tick, and end it with its rotation."""
        goal = self._goal
        if goal is None or goal.rotation is not rotation:
            return
        if rotation.state is RotationState.CANCELED:
            self._node.get_logger().info("Rotation goal canceled")
            self._end(goal)
            return
        goal.handle.publish_feedback(RotateAbsolute.Feedback(remaining=rotation.remaining))
        if rotation.state is RotationState.SUCCEEDED:
            self._node.get_logger().info("Rotation goal completed successfully")
            self._end(goal)

    def abort(self) -> None:
        """Abort the goal: its rotation was aborted."""
        if self._goal is not None:
            self._end(self._goal)

    def destroy(self) -> None:
        """Abort the goal, if there is one, and leave the graph."""
        if self._goal is not None:
            self._goal.rotation.state = RotationState.ABORTED
            self._end(self._goal)
        self._server.destroy()

    def _on_goal(self, goal: Any) -> GoalResponse:
        if math.isfinite(goal.theta):
            return GoalResponse.ACCEPT
        self._node.get_logger().error(
            f"Cannot rotate [{self._turtle.name}] to a heading that is not finite: {goal.theta}"
        )
        return GoalResponse.REJECT

    def _on_cancel(self, handle: ServerGoalHandle) -> CancelResponse:
        if self._goal is not None and self._goal.handle == handle:
            # The next tick of the model carries it out.
            self._goal.rotation.cancel_requested = True
        return CancelResponse.ACCEPT

    async def _execute(self, handle: ServerGoalHandle) -> Any:
        rotation, aborted = self._turtle.rotate_to(handle.request.theta)
        if aborted is not None:
            self._node.get_logger().warning(
                "Rotation goal received before a previous goal finished. Aborting previous goal"
            )
            self.abort()
        # The request to cancel may have come between the acceptance and here.
        rotation.cancel_requested = handle.is_cancel_requested
        goal = self._goal = _Goal(handle, rotation)
        await goal.ended
        return RotateAbsolute.Result(delta=rotation.delta)

    def _end(self, goal: _Goal) -> None:
        self._goal = None
        if goal.rotation.state is RotationState.SUCCEEDED:
            goal.handle.succeed()
        elif goal.rotation.state is RotationState.CANCELED:
            goal.handle.canceled()
        else:
            goal.handle.abort()
        goal.ended.set_result(None)
