"""The swarm: each turtle follows the one before it, all of them in one process."""

from __future__ import annotations

import itertools
import signal
import threading

import pytest
from tests.places import LEARNING, ROS2

from turtlewire import Buffer, msg
from turtlewire.tf.listener import QOS, TOPIC, TYPE_NAME, TransformListener
from turtlewire.wire.base import TypeId

PACKAGE = LEARNING
COUNT = 20
NAMES = [f"turtle{k}" for k in range(1, COUNT + 1)]


@pytest.mark.slow
def test_a_swarm_of_twenty_closes_up(run, workspace, turtles):
    for name in NAMES[2:]:
        turtles.watch(name)
    launch = run(
        ROS2,
        "launch",
        "learning_tf2_py",
        "swarm.launch.py",
        f"count:={COUNT}",
        environment=workspace(PACKAGE),
    )
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

    launch.signal_group(signal.SIGINT)
    assert launch.wait() == 0
    assert launch.survivors() == []
    assert "Traceback" not in launch.text
    assert "hit the wall" not in launch.text
    assert launch.text.count("process has finished cleanly") == 1


def test_the_swarm_joins_a_simulator_that_runs_already(run, workspace, turtles):
    environment = workspace(PACKAGE)
    field = run(ROS2, "run", "turtlesim", "turtlesim_node", "--headless", environment=environment)
    field.wait_for("Spawning turtle .turtle1")
    swarm = run(
        ROS2,
        "run",
        "learning_tf2_py",
        "swarm",
        "--ros-args",
        "-p",
        "count:=3",
        environment=environment,
    )
    swarm.wait_for("3 of 3 turtles follow the one before them")
    turtles.watch("turtle3")
    turtles.wait_for(lambda: len(turtles.poses) == 3 and turtles.distance() < 0.5)
    swarm.signal_group(signal.SIGINT)
    assert swarm.wait() == 0
    assert "Traceback" not in swarm.text
