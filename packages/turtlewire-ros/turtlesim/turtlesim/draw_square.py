"""Drives turtle1 along a square, again and again, by looking at its poses only."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable
from enum import Enum
from typing import Any, NamedTuple

import rclpy
from geometry_msgs.msg import Twist
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_srvs.srv import Empty
from turtlesim.msg import Pose

# All numbers are the original's.
SIDE = 2.0
FORWARD_SPEED = 1.0
TURNING_SPEED = 0.4
POSITION_TOLERANCE = 0.1
HEADING_TOLERANCE = 0.01
STOPPED = 0.0001
PERIOD_S = 0.016


class SquareGoal(NamedTuple):
    """A target position [m] and heading [rad] of the turtle."""

    x: float
    y: float
    theta: float


class _Phase(Enum):
    FORWARD = "forward"
    STOP_AFTER_FORWARD = "stop after forward"
    TURN = "turn"
    STOP_AFTER_TURN = "stop after turn"


class SquarePlan:
    """Decides what to command next. Knows poses, and nothing of ROS.

    Args:
        log: Called with each line to be logged.
    """

    def __init__(self, log: Callable[[str], object]) -> None:
        self._log = log
        self._phase: _Phase | None = None
        self._goal = SquareGoal(0.0, 0.0, 0.0)

    def command(self, pose: Any) -> tuple[float, float]:
        """Return speed [m/s] and turning rate [rad/s] for the newest ``pose`` of a turtle."""
        if self._phase is None:
            self._set_goal(_Phase.FORWARD, _ahead_of(pose))
            return 0.0, 0.0
        if self._phase is _Phase.FORWARD:
            return self._move(pose, FORWARD_SPEED, 0.0, _Phase.STOP_AFTER_FORWARD)
        if self._phase is _Phase.TURN:
            return self._move(pose, 0.0, TURNING_SPEED, _Phase.STOP_AFTER_TURN)
        if abs(pose.angular_velocity) < STOPPED and abs(pose.linear_velocity) < STOPPED:
            self._log("Reached goal")
            if self._phase is _Phase.STOP_AFTER_FORWARD:
                self._set_goal(_Phase.TURN, _left_of(pose))
            else:
                self._set_goal(_Phase.FORWARD, _ahead_of(pose))
        return 0.0, 0.0

    def _move(
        self, pose: Any, forward: float, turning: float, afterwards: _Phase
    ) -> tuple[float, float]:
        x, y, theta = self._goal
        if (
            abs(pose.x - x) < POSITION_TOLERANCE
            and abs(pose.y - y) < POSITION_TOLERANCE
            and abs(pose.theta - theta) < HEADING_TOLERANCE
        ):
            self._phase = afterwards
            return 0.0, 0.0
        return forward, turning

    def _set_goal(self, phase: _Phase, goal: SquareGoal) -> None:
        self._phase, self._goal = phase, goal
        self._log(f"New goal [{goal.x:f} {goal.y:f}, {goal.theta:f}]")


def _ahead_of(pose: Any) -> SquareGoal:
    return SquareGoal(
        math.cos(pose.theta) * SIDE + pose.x, math.sin(pose.theta) * SIDE + pose.y, pose.theta
    )


def _left_of(pose: Any) -> SquareGoal:
    theta = math.fmod(pose.theta + math.pi / 2, 2 * math.pi)
    return SquareGoal(pose.x, pose.y, theta - 2 * math.pi if theta > math.pi else theta)


class DrawSquare(Node):
    """Resets the simulator, then commands turtle1 every 16 ms."""

    def __init__(self) -> None:
        super().__init__("draw_square")
        self._pose: Any = None
        self._plan = SquarePlan(self.get_logger().info)
        self._reset = self.create_client(Empty, "reset")
        self.create_subscription(Pose, "turtle1/pose", self._on_pose, 1)
        self._twist = self.create_publisher(Twist, "turtle1/cmd_vel", 1)

    def reset_and_start(self) -> None:
        """Wait for the simulator, reset it, and start drawing."""
        self._reset.wait_for_service()
        # As in the original, the drawing does not wait for the response.
        self._reset.call_async(Empty.Request())
        self.create_timer(PERIOD_S, self._on_timer)

    def _on_pose(self, pose: Any) -> None:
        self._pose = pose

    def _on_timer(self) -> None:
        if self._pose is None:
            return
        message = Twist()
        message.linear.x, message.angular.z = self._plan.command(self._pose)
        self._twist.publish(message)


def main(args: list[str] | None = None) -> None:
    """Run until Ctrl-C."""
    # RCLError: SIGTERM while it waits for the simulator makes the context of the wait invalid.
    ended = contextlib.suppress(KeyboardInterrupt, ExternalShutdownException, RCLError)
    with ended, rclpy.init(args=args):
        node = DrawSquare()
        node.reset_and_start()
        rclpy.spin(node)


if __name__ == "__main__":
    main()
