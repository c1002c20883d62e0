"""The robot of examples/mujoco_robot, in a process of its own, and a connection to its network."""

import sys

import pytest
from tests.places import EXAMPLES

import turtlewire

ROBOT = EXAMPLES / "mujoco_robot" / "mujoco_robot.py"


@pytest.fixture
def robot(run):
    """Starts the robot, and waits until it simulates; arguments are its parameters."""
    started = []

    def start(environment=None, **parameters):
        values = [word for key, value in parameters.items() for word in ("-p", f"{key}:={value}")]
        command = [sys.executable, "-W", "error", ROBOT, "--ros-args", *values]
        started.append(run(*command, environment=environment))
        started[-1].wait_for(r"\[mujoco_robot\]: simulating ")
        return started[-1]

    yield start
    for program in started:
        program.end()


@pytest.fixture
def net():
    with turtlewire.connect("observer") as connection:
        yield connection
