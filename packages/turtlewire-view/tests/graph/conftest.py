"""A page of the graph, nodes for it, and a page that is no browser."""

from __future__ import annotations

import contextlib

import pytest

from turtlewire import msg, wire
from turtlewire.wire import conflicts
from turtlewire.wire.base import EndpointInfo, NodeInfo, TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view.graph.graph_page import GraphPage
from turtlewire_view.graph.picture import Picture, Selection, read_graph

from ..view.conftest import LIMIT_S, Page

STRING = "std_msgs/msg/String"
DEFAULT = QoS()
BEST_EFFORT = QoS(depth=5, reliability=Reliability.BEST_EFFORT)
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


class Nodes:
    """Nodes on the wire, in a context of their own."""

    def __init__(self):
        self.context = wire.open_context()
        self._nodes = {}

    def node(self, name):
        if name not in self._nodes:
            self._nodes[name] = self.context.create_node(name)
        return self._nodes[name]

    def publisher(self, node, topic, qos=DEFAULT, type_name="std_msgs/msg/String"):
        return self.node(node).create_publisher(topic, self._type(type_name), qos)

    def subscription(self, node, topic, qos=DEFAULT, type_name="std_msgs/msg/String"):
        return self.node(node).create_subscription(topic, self._type(type_name), qos)

    def wait_for(self, predicate):
        """Whether it becomes true, looked at after each change of the graph."""
        return self.context.graph.wait_for(predicate, LIMIT_S * 10**9)

    def subscribers(self, topic):
        return self.context.graph.endpoints_of(topic, "subscription")

    @staticmethod
    def _type(name):
        return TypeId(name, msg.type_hash(name))


class Peer(Page):
    """Collects messages, as a browser's page does."""

    def wait_for(self, kind, accept=lambda message: True):
        """The newest message of a kind if it is accepted, perhaps one that is still to come."""

        def find():
            newest = next((each for each in self._packets[::-1] if each["type"] == kind), None)
            return newest if newest is not None and accept(newest) else None

        with self._news:
            assert self._news.wait_for(find, LIMIT_S), (kind, self._packets[-2:])
            return find()

    def wait_for_names(self, *names):
        """Wait until exactly these nodes are shown."""
        return self.wait_for("graph", lambda each: node_names(each) == [*names])


def node_names(message):
    return [node["node"] for node in message["graph"]["nodes"]]


@pytest.fixture(autouse=True)
def _compares_qos(monkeypatch):
    """Let QoS keep endpoints apart, whatever the middleware of this machine is."""
    monkeypatch.setattr(conflicts, "compares_qos", lambda: True)


@pytest.fixture
def nodes():
    nodes = Nodes()
    yield nodes
    nodes.context.close()


@pytest.fixture
def graph_page():
    with (
        contextlib.closing(wire.open_context()) as context,
        GraphPage(context, Selection(), port=0) as page,
    ):
        yield page


@pytest.fixture
def peer(graph_page):
    with contextlib.closing(Peer(graph_page.url)) as peer:
        yield peer


class KnownGraph:
    """The part of a graph that :func:`read_graph` reads."""

    def __init__(self) -> None:
        self._nodes: list[NodeInfo] = []
        self._endpoints: list[EndpointInfo] = []

    def node(self, name, publishes=(), subscribes=()):
        """Add a node; topics are names, or names with QoS and type."""
        space, _, own = name.rpartition("/")
        node = NodeInfo(own, space or "/", "/")
        self._nodes.append(node)
        for kind, topics in (("publisher", publishes), ("subscription", subscribes)):
            for each in topics:
                topic, qos, type_name = (each, DEFAULT, STRING) if isinstance(each, str) else each
                self.add(kind, topic, type_name, node, qos)
        return self

    def add(self, kind, topic, type_name, node, qos=DEFAULT):
        gid = len(self._endpoints).to_bytes(16, "big")
        self._endpoints.append(EndpointInfo(kind, topic, type_name, "", node, gid, qos))

    def nodes(self):
        return self._nodes

    def endpoints(self):
        return self._endpoints

    def picture(self) -> Picture:
        return read_graph(self, 7)


def robot() -> KnownGraph:
    """A small robot with one mistake of each kind."""
    return (
        KnownGraph()
        .node("/lidar", [("/scan", BEST_EFFORT, STRING), "/rosout"])
        .node("/slam", ["/map"], ["/scan"])
        .node("/planner", ["/cmd_vel"], [("/map", LATCHED, STRING)])
        .node("/wheels", (), [("/cmd_vel", DEFAULT, "std_msgs/msg/Int32")])
        .node("/robot2/camera", ["/robot2/image"])
        .node("/_hidden", ["/parameter_events"])
    )


def large(nodes: int = 300) -> KnownGraph:
    """Ten robots, each with circles of nodes; one topic that most use."""
    graph = KnownGraph()
    for number in range(nodes):
        space = f"/robot{number % 10}"
        near = [(number + 10 * step) % nodes for step in (1, 3)]
        graph.node(
            f"{space}/node_{number}",
            [f"{space}/topic_{number}", f"{space}/state_{number}", "/tf"],
            [f"{space}/topic_{each}" for each in near] + ["/clock"] * (number % 3 == 0),
        )
    return graph
