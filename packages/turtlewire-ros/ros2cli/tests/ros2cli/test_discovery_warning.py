"""The warning of a command whose node can discover nothing."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"

WARNING = """\
Warning: ROS_AUTOMATIC_DISCOVERY_RANGE=OFF with no ROS_STATIC_PEERS configured.
No discovery mechanism is available. Results will be empty.
Either:
  - Set ROS_STATIC_PEERS to specify peers explicitly, or
  - Change ROS_AUTOMATIC_DISCOVERY_RANGE to LOCALHOST or SUBNET
"""


def said(words, **variables):
    command = [sys.executable, "-c", ROS2, *words.split()]
    environment = {**os.environ, **variables}
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    return done.stderr


@pytest.mark.parametrize("words", ["topic list", "node list", "param list"])
def test_a_node_that_discovers_nothing_warns_once(words):
    assert said(words, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF") == WARNING


def test_other_configurations_have_no_warning():
    assert said("topic list", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST") == ""
    peers = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "ROS_STATIC_PEERS": "127.0.0.1"}
    assert said("topic list", **peers) == ""
    assert said("pkg prefix rclpy", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF") == ""
