"""QoS on the command lines of extensions."""

import argparse

import pytest
from tests.programs import lines_in

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from ros2cli.node.strategy import NodeStrategy
from ros2cli.qos import add_qos_arguments, choose_qos
from std_msgs.msg import String


@pytest.fixture
def parser():
    parser = argparse.ArgumentParser()
    add_qos_arguments(parser, "subscribe", "sensor_data", " and more")
    return parser


def test_the_chosen_profile(parser):
    assert "QoS to subscribe with (default: sensor_data) and more" in parser.format_help()
    with NodeStrategy(None, node_name="chooser") as node:
        assert node.get_name() == "chooser"
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        node.create_publisher(String, "/latched", latched)
        matching = choose_qos(node, "/latched", parser.parse_args([]))
        assert matching.durability == DurabilityPolicy.TRANSIENT_LOCAL
        assert matching.reliability == ReliabilityPolicy.RELIABLE
        asked = choose_qos(node.node, "/latched", parser.parse_args(["--qos-depth", "3"]))
        assert (asked.depth, asked.reliability) == (3, ReliabilityPolicy.BEST_EFFORT)


@pytest.mark.parametrize("as_json", [False, True])
def test_different_publishers_are_reported_outside_of_json(parser, capsys, as_json):
    with NodeStrategy(None, node_name="chooser") as node:
        for policy in ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT:
            node.create_publisher(String, "/mixed", QoSProfile(depth=1, reliability=policy))
        chosen = choose_qos(node, "/mixed", argparse.Namespace(json=as_json))
    assert chosen.reliability == ReliabilityPolicy.BEST_EFFORT
    told = capsys.readouterr()
    assert "offering QoSReliabilityPolicy.RELIABLE. " in (told.err if as_json else told.out)
    assert (told.out if as_json else told.err) == ""


def test_the_parameters_of_ros2topic_follow_the_distribution():
    program = "import inspect; from ros2topic.api import add_qos_arguments as each; "
    program += "print(*inspect.signature(each).parameters)"
    assert lines_in("jazzy", program) == ["parser subscribe_or_publish default_profile_str"]
    later = ["parser entity_type default_profile_str extra_message"]
    assert lines_in("kilted", program) == later
