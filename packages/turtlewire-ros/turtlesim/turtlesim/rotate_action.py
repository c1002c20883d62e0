"""The action ``rotate_absolute`` of one turtle, served by a rotation of the model."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.task import Future
from turtlesim.action import RotateAbsolute
from turtlesim.model import RotationState

if TYPE_CHECKING:
    from rclpy.action.server import ServerGoalHandle
    from rclpy.node import Node
    from turtlesim.model import Rotation, Turtle


class _Goal:
    """A goal, its rotation, and the future that its execution awaits."""

    def __init__(self, handle: ServerGoalHandle, rotation: Rotation) -> None:
        self.handle = handle
        self.rotation = rotation
        self.ended = Future()


class RotateAction:
    """Serves the action; the simulator calls :meth:`report` at each tick. Not thread-safe."""

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
