"""A program that drives something says when nothing listens, and in which domains there are nodes.

Teleop on another domain than the simulator was silent.
"""

from __future__ import annotations

import re
import sys

import pytest

from rclpy.impl import unheard
from std_msgs.msg import String
from turtlewire.doctor import network


@pytest.fixture
def look(monkeypatch, node, spin_until, capfd):
    """Publish with a timer that fires soon, and return what was logged."""
    monkeypatch.setattr(unheard, "_PATIENCE_S", 0.01)

    def look(ports=()):
        monkeypatch.setattr(network, "udp_ports", lambda: set(ports))
        publisher = node.create_publisher(String, "cmd_vel", 1)
        before = len(list(node.timers))
        unheard.warn_if_unheard(node, publisher)
        spin_until(lambda: len(list(node.timers)) == before)
        return capfd.readouterr().err

    return look


def port_of(domain):
    return 7400 + 250 * domain + 10


def test_without_a_subscription_and_without_other_nodes(look, context):
    domain = context.get_domain_id()
    assert (
        look([port_of(domain)])
        .rstrip()
        .endswith(
            f"[tested]: No node subscribes to /cmd_vel on domain {domain}. "
            "Is the node running that it is for?"
        )
    )


def test_other_domains_are_named(look, context):
    domain = context.get_domain_id()
    first, second = sorted({3, 4, 5} - {domain})[:2]
    text = look([port_of(second), port_of(first), port_of(domain)])
    assert (
        f"This computer has nodes on domain {first}, {second}: to reach them, end this program "
        f"and type: export ROS_DOMAIN_ID={first}"
    ) in text


def test_with_a_subscription_nothing_is_said(look, node):
    node.create_subscription(String, "cmd_vel", lambda _: None, 1)
    assert look([port_of(3)]) == ""


@pytest.mark.parametrize(
    ("module", "topic"),
    [
        ("turtlesim.turtle_teleop_key", "/turtle1/cmd_vel"),
        ("teleop_twist_keyboard.teleop", "/cmd_vel"),
    ],
)
def test_teleop_says_that_nothing_listens(run, module, topic):
    program = f"import sys; from {module} import main; sys.exit(main())"
    teleop = run(sys.executable, "-c", program, terminal=True)
    teleop.wait_for(rf"No node subscribes to {re.escape(topic)} on domain \d+\.")
    teleop.type("q" if "turtle1" in topic else "\x03")
    assert teleop.wait() == 0
