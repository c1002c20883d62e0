"""Warnings of a publisher without subscriptions, with the domains that have nodes.

Teleop on another domain than the simulator was silent.
"""

import os
import re
import signal
import sys

import pytest

from rclpy.impl import unheard
from ros2cli.main import main
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
            "Is the node that should receive it running?"
        )
    )


def test_other_domains_are_named(look, context):
    domain = context.get_domain_id()
    first, second = sorted({3, 4, 5} - {domain})[:2]
    text = look([port_of(second), port_of(first), port_of(domain)])
    assert (
        f"This computer has nodes on domains {first} and {second}: to reach them, end this program "
        f"and type: export ROS_DOMAIN_ID={first}"
    ) in text


def test_a_topic_without_a_publisher(node, context, spin_until, capfd, monkeypatch):
    monkeypatch.setattr(unheard, "_PATIENCE_S", 0.01)
    domain = context.get_domain_id()
    other = 3 if domain != 3 else 4
    monkeypatch.setattr(network, "udp_ports", lambda: {port_of(other)})
    timers = len(list(node.timers))
    unheard.warn_if_silent(node, "/scan")
    spin_until(lambda: len(list(node.timers)) == timers)
    assert (
        f"No node publishes /scan on domain {domain}. This computer has nodes on domain {other}"
        in capfd.readouterr().err
    )
    node.create_publisher(String, "/scan", 1)
    unheard.warn_if_silent(node, "/scan")
    spin_until(lambda: len(list(node.timers)) == timers)
    assert capfd.readouterr().err == ""


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


@pytest.mark.parametrize(
    ("words", "warning"),
    [
        ("pub /x std_msgs/msg/String -t 1 -w 0 --keep-alive 600", "No node subscribes to /x"),
        ("pub /x std_msgs/msg/String --once", "No node subscribes to /x"),
        ("echo /x std_msgs/msg/String", "No node publishes /x"),
    ],
)
def test_the_verbs_of_topics_say_that_there_is_no_other_end(run, words, warning):
    program = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"
    verb = run(sys.executable, "-c", program, "topic", *words.split())
    verb.wait_for(rf"{warning} on domain \d+\.")
    verb.signal_group(signal.SIGINT)
    assert verb.wait() == 2


def test_a_topic_that_another_domain_may_have(capsys, monkeypatch):
    other = 3 if os.environ["ROS_DOMAIN_ID"] != "3" else 4
    monkeypatch.setattr(network, "udp_ports", lambda: {port_of(other)})
    assert main(["topic", "echo", "/x"]) == 1
    hint, error = capsys.readouterr().err.splitlines()
    assert hint.endswith(f"export ROS_DOMAIN_ID={other}")
    assert error == "Could not determine the type for the passed topic"
