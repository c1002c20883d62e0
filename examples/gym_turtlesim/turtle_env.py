"""A Gymnasium environment: drive the turtle of turtlesim to a goal.

It steps the model of turtlesim, without nodes and without a network.
"""

from __future__ import annotations

import math
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from turtlesim.model import FIELD_SIZE, TICK_NS, Turtle

TICKS = 6  # of 16 ms, for each step
SPEED, TURNING_RATE = 2.0, 2.0  # of an action of 1 [m/s, rad/s]
REACHED = 0.5  # distance from the goal at which an episode ends [m]
COST = 0.01  # of each step


class TurtleEnv(gymnasium.Env[np.ndarray, np.ndarray]):
    """A turtle and a goal at random places in the field.

    An action is a speed and a turning rate, both from -1 to 1. An observation is the position of
    the goal in the frame of the turtle: ahead and to the left [m]. The reward is the distance that
    the turtle has come nearer to the goal [m], minus the cost of a step.
    """

    def __init__(self) -> None:
        diagonal = math.hypot(FIELD_SIZE, FIELD_SIZE)
        self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
        self.observation_space = spaces.Box(-diagonal, diagonal, (2,), np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Begin an episode; the same seed begins the same one."""
        super().reset(seed=seed, options=options)
        x, y, *self._goal = self.np_random.uniform(1.0, FIELD_SIZE - 1.0, 4).tolist()
        heading = self.np_random.uniform(-math.pi, math.pi)
        self._turtle, self._now_ns = Turtle("turtle1", x, y, heading), 0
        return self._observe(), {}

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Drive for about a tenth of a simulated second."""
        before = self._distance()
        speed, turning = np.clip(action, -1.0, 1.0).tolist()
        self._turtle.drive(SPEED * speed, 0.0, TURNING_RATE * turning)
        for _ in range(TICKS):
            self._now_ns += TICK_NS
            self._turtle.step(self._now_ns)
        distance = self._distance()
        return self._observe(), before - distance - COST, distance < REACHED, False, {}

    def _distance(self) -> float:
        pose = self._turtle.pose
        return math.hypot(self._goal[0] - pose.x, self._goal[1] - pose.y)

    def _observe(self) -> np.ndarray:
        pose = self._turtle.pose
        dx, dy = self._goal[0] - pose.x, self._goal[1] - pose.y
        cos, sin = math.cos(pose.theta), math.sin(pose.theta)
        return np.array([cos * dx + sin * dy, cos * dy - sin * dx], np.float32)


gymnasium.register("TurtleGoal-v0", entry_point=f"{__name__}:TurtleEnv", max_episode_steps=300)
