"""Queries of the graph."""

import argparse
import contextlib
import math
import os

import pytest
from tests.programs import ROS2

from ros2cli import graph as ask
from ros2cli.discovery import wait_until_discovered
from ros2cli.main import main
from ros2cli.node.direct import DirectNode
from ros2param.parameters import _serving
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.environment import lingers
from turtlewire.wire.qos import Durability, QoS, Reliability

HASH = "RIHS01_" + "0" * 64


@pytest.fixture
def context():
    opened = open_context(middleware="local")
    yield opened
    opened.close()


@pytest.fixture
def graph(context):
    def kind(name):
        return TypeId(name, HASH)

    def service(name):
        return ServiceTypes(name, kind(f"{name}_Request"), kind(f"{name}_Response"), lambda _: HASH)

    node = context.create_node("sim")
    node.create_publisher("/pose", kind("turtlesim/msg/Pose"), QoS())
    node.create_publisher(
        "/turn/_action/feedback", kind("turtlesim/action/RotateAbsolute_FeedbackMessage"), QoS()
    )
    node.create_service("/spawn", service("turtlesim/srv/Spawn"), QoS())
    node.create_service("/turn/_action/send_goal", service("a/action/B_SendGoal"), QoS())
    other = context.create_node("listener", "/robot")
    other.create_subscription("/pose", kind("turtlesim/msg/Pose"), QoS())
    other.create_subscription(
        "/turn/_action/feedback", kind("turtlesim/action/RotateAbsolute_FeedbackMessage"), QoS()
    )
    other.create_client("/spawn", service("turtlesim/srv/Spawn"), QoS())
    context.create_node("_hidden")
    return context.graph


def test_topics_and_services_hide_those_with_an_underscore(graph):
    assert ask.topics(graph) == [("/pose", ["turtlesim/msg/Pose"])]
    assert [name for name, _ in ask.topics(graph, hidden=True)] == [
        "/pose",
        "/turn/_action/feedback",
    ]
    assert ask.services(graph) == [("/spawn", ["turtlesim/srv/Spawn"])]
    assert [name for name, _ in ask.services(graph, hidden=True)] == [
        "/spawn",
        "/turn/_action/send_goal",
    ]


def test_nodes(graph):
    assert ask.node_names(graph) == ["/robot/listener", "/sim"]
    assert "/_hidden" in ask.node_names(graph, hidden=True)
    assert ask.node_exists(graph, "/_hidden")
    assert not ask.node_exists(graph, "/nope")


def test_node_info(graph):
    assert ask.publishers(graph, "/sim") == [("/pose", ["turtlesim/msg/Pose"])]
    assert ask.subscribers(graph, "/sim") == []
    assert ask.subscribers(graph, "/robot/listener") == [("/pose", ["turtlesim/msg/Pose"])]
    assert ask.service_servers(graph, "/sim") == [("/spawn", ["turtlesim/srv/Spawn"])]
    assert ask.service_clients(graph, "/sim") == []
    assert ask.service_clients(graph, "/robot/listener") == [("/spawn", ["turtlesim/srv/Spawn"])]


def test_actions(graph):
    assert ask.actions(graph) == [("/turn", ["turtlesim/action/RotateAbsolute"])]
    assert (
        ask.action_servers(graph, "/sim")
        == ask.action_clients(graph, "/robot/listener")
        == ask.actions(graph)
    )
    assert ask.action_nodes(graph, "/turn", "publisher") == [
        ("/sim", ["turtlesim/action/RotateAbsolute"])
    ]
    assert ask.action_nodes(graph, "/turn", "subscription") == [
        ("/robot/listener", ["turtlesim/action/RotateAbsolute"])
    ]


class Incomplete:
    """A graph that is complete after some news."""

    def __init__(self, news_needed):
        self.news_needed = news_needed
        self.listeners = []
        self.hurries = False

    def hurry(self):
        self.hurries = True

    def add_listener(self, listener):
        self.listeners.append(listener)
        if self.news_needed:
            self.news_needed -= 1
            listener()
        return lambda: self.listeners.remove(listener)

    def is_complete(self):
        return not self.news_needed


def test_a_complete_graph_is_not_waited_for(monkeypatch):
    monkeypatch.setattr("ros2cli.discovery._PATIENCE_S", math.inf)
    graph = Incomplete(news_needed=0)
    wait_until_discovered(graph)
    assert graph.listeners == []


def test_news_end_the_wait_when_they_complete_the_graph():
    graph = Incomplete(news_needed=1)
    wait_until_discovered(graph)
    assert graph.hurries
    assert graph.listeners == []


def test_lost_data_is_not_waited_for_forever(monkeypatch):
    monkeypatch.setattr("ros2cli.discovery._PATIENCE_S", 0.1)
    graph = Incomplete(news_needed=2)
    wait_until_discovered(graph)
    assert graph.listeners == []


@pytest.mark.parametrize("waits", [True, False])
def test_a_verb_that_has_its_answers_leaves_without_waiting(monkeypatch, waits):
    lingering = []
    monkeypatch.setattr("rclpy.init", lambda args: lingering.append(lingers()))
    monkeypatch.setattr("rclpy.create_node", lambda *_, **__: None)
    DirectNode(argparse.Namespace(), lingers=waits)
    assert lingering == [waits]
    assert lingers()


def test_the_commands_own_node_is_listed_only_without_a_daemon(capsys):
    own = f"/_ros2cli_{os.getpid()}"
    assert main(["node", "list", "-a"]) == 0
    assert own not in capsys.readouterr().out.splitlines()
    assert main(["node", "list", "-a", "--no-daemon"]) == 0
    assert own in capsys.readouterr().out.splitlines()


def test_a_hidden_node_is_shown_only_when_asked_for(capsys):
    other = open_context()
    other.create_node("_hidden")
    try:
        assert main(["node", "info", "/_hidden"]) == 1
        assert capsys.readouterr().err.startswith("Unable to find node '/_hidden'\n")
        assert main(["node", "info", "--include-hidden", "/_hidden"]) == 0
        assert capsys.readouterr().out.startswith("/_hidden\n  Subscribers:")
    finally:
        other.close()


def test_the_services_of_a_node_that_has_just_started_are_waited_for(monkeypatch):
    """Its name may arrive before its services do."""
    asked = []

    def services(graph, **_):
        """Those at a second question alone, before which the graph has changed."""
        asked.append(graph)
        if len(asked) == 1:
            context.create_node("news")
            return []
        return [("/late/list_parameters", [])]

    monkeypatch.setattr("ros2cli.graph.services", services)
    with contextlib.closing(open_context(middleware="local")) as context:
        direct = argparse.Namespace(graph=context.graph)
        assert _serving(direct, ["/late"], "list_parameters", 60.0) == {"/late"}


@pytest.mark.parametrize("verb", ["hz", "bw", "delay"])
def test_statistics_do_not_ask_for_the_history_of_a_topic(run, verb):
    other = open_context()
    try:
        kind = TypeId(
            "geometry_msgs/msg/PointStamped", msg.type_hash("geometry_msgs/msg/PointStamped")
        )
        latched = QoS(durability=Durability.TRANSIENT_LOCAL, depth=50)
        node = other.create_node("map")
        publisher = node.create_publisher("/map", kind, latched)
        publisher.publish(msg.serialize(msg.get_message("geometry_msgs/msg/PointStamped")()))
        run(*ROS2, "topic", verb, "/map")

        def subscriptions():
            return ask.endpoints_of_topic(other.graph, "/map", "subscription")

        assert other.graph.wait_for(lambda: bool(subscriptions()), 60_000_000_000)
        (found,) = subscriptions()
        assert found.qos.durability == Durability.VOLATILE
        assert found.qos.reliability == Reliability.BEST_EFFORT
    finally:
        other.close()
