"""The swarm: each turtle follows the one before it, all of them in one process.

Our own tutorial package: two turtles appear, one follows.

And the static broadcaster that the tutorial's setup.py names.
"""

from __future__ import annotations

import itertools
import os
import signal
import subprocess
import sys
import threading

import pytest
from tests.places import LEARNING

from turtlewire import Buffer, msg
from turtlewire.tf.listener import QOS, TOPIC, TYPE_NAME, TransformListener
from turtlewire.wire.base import TypeId

COUNT = 20
NAMES = [f"turtle{k}" for k in range(1, COUNT + 1)]


@pytest.mark.slow
def test_a_swarm_of_twenty_closes_up(ros2, turtles):
    for name in NAMES[2:]:
        turtles.watch(name)
    launch = ros2("launch", "learning_tf2_py", "swarm.launch.py", f"count:={COUNT}")
    launch.wait_for(f"{COUNT} of {COUNT} turtles follow the one before them")
    turtles.wait_for(lambda: len(turtles.poses) == COUNT)

    def apart() -> list[float]:
        return [turtles.distance(one, other) for one, other in itertools.pairwise(NAMES)]

    before = apart()
    buffer, sizes, heard = Buffer(), [], threading.Event()

    def on_transforms(cdr, _):
        sizes.append(len(msg.deserialize(msg.get_message(TYPE_NAME), cdr).transforms))
        if len(sizes) == 50:
            heard.set()

    turtles.node.create_subscription(
        TOPIC, TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS, on_transforms
    )
    with TransformListener(buffer, turtles.node, context=turtles.context):
        for one, other in itertools.pairwise(NAMES):
            assert buffer.lookup_transform(other, one, timeout_ns=60_000_000_000).stamp_ns > 0
    assert heard.wait(60)
    assert max(sizes) == COUNT // 5  # a fifth of the turtles in one message
    turtles.wait_for(lambda: sum(apart()) < 0.5 * sum(before) and max(apart()) < max(before))

    launch.end(1)
    assert "hit the wall" not in launch.text


def test_the_swarm_joins_a_simulator_that_runs_already(ros2, turtles):
    field = ros2("run", "turtlesim", "turtlesim_node", "--headless")
    field.wait_for("Spawning turtle .turtle1")
    swarm = ros2("run", "learning_tf2_py", "swarm", "--ros-args", "-p", "count:=3")
    swarm.wait_for("3 of 3 turtles follow the one before them")
    turtles.watch("turtle3")
    turtles.wait_for(lambda: len(turtles.poses) == 3 and turtles.distance() < 0.5)
    swarm.end()


LONG_NS = 60_000_000_000


def test_two_turtles_appear_and_one_follows(ros2, turtles):
    launch = ros2("launch", "learning_tf2_py", "turtle_tf2_demo.launch.py")
    launch.wait_for("Successfully spawned turtle2")
    turtles.wait_for(lambda: len(turtles.poses) == 2 and turtles.distance() < 1.0)
    buffer = Buffer()
    with TransformListener(buffer, turtles.node, context=turtles.context):
        assert buffer.lookup_transform("turtle2", "turtle1", timeout_ns=LONG_NS).stamp_ns > 0

    launch.end(4)


def test_a_turtle_that_is_there_is_not_spawned_again(ros2, turtles):
    field = ros2("run", "turtlesim", "turtlesim_node")
    field.wait_for("Spawning turtle .turtle1")
    first = ros2("run", "learning_tf2_py", "turtle_tf2_listener")
    field.wait_for("Spawning turtle .turtle2")
    turtles.wait_for(lambda: "turtle2" in turtles.poses)
    first.signal_group(signal.SIGINT)
    first.wait()
    second = ros2("run", "learning_tf2_py", "turtle_tf2_listener")
    second.wait_for("Could not retrieve transform", count=2)
    field.signal_group(signal.SIGINT)
    field.wait()
    assert "already exists" not in field.text


def test_the_static_broadcaster_is_heard_by_late_joiners(ros2, turtles):
    arguments = ["thing", "1", "2", "0.5", "0", "0", "1.5707963267948966"]
    program = ros2("run", "learning_tf2_py", "static_turtle_tf2_broadcaster", *arguments)
    buffer = Buffer()
    with TransformListener(buffer, turtles.node, context=turtles.context):
        found = buffer.lookup_transform("world", "thing", timeout_ns=LONG_NS)
    assert found.translation == (1.0, 2.0, 0.5)
    assert found.rotation == pytest.approx((0.0, 0.0, 0.5**0.5, 0.5**0.5))
    program.end()


@pytest.mark.parametrize(
    "arguments", [[], ["thing", "1"], ["thing", *"12345", "six"], ["world", *"123456"]]
)
def test_the_static_broadcaster_explains_itself(ros2, arguments):
    program = ros2("run", "learning_tf2_py", "static_turtle_tf2_broadcaster", *arguments)
    assert program.wait() != 0
    assert (
        "usage: ros2 run learning_tf2_py static_turtle_tf2_broadcaster NAME X Y Z ROLL PITCH YAW"
        in program.text
    )
    assert "Traceback" not in program.text


def test_the_package_s_own_tests():
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test"]
    path = os.pathsep.join(part for part in (str(LEARNING), os.environ.get("PYTHONPATH")) if part)
    done = subprocess.run(
        command,
        cwd=LEARNING,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "5 passed" in done.stdout
