"""Names for publishers, from a graph that learns them late."""

from __future__ import annotations

from turtlewire.tf.publishers import PublisherNames
from turtlewire.wire.base import EndpointInfo, NodeInfo
from turtlewire.wire.graph import GraphView
from turtlewire.wire.qos import QoS

GID, OTHER = b"\x01" * 16, b"\x02" * 16


class Graph(GraphView):
    """Counts how often it is asked."""

    def __init__(self):
        super().__init__()
        self.known = {GID: None}
        self.asked = 0

    def nodes(self):
        return []

    def endpoints(self):
        self.asked += 1
        return [
            EndpointInfo("publisher", "/tf", "t", "", node, gid, QoS())
            for gid, node in self.known.items()
        ]


def test_the_graph_is_asked_once_for_each_publisher_and_after_its_changes():
    graph, renamed = Graph(), []
    names = PublisherNames(graph, lambda gid, name: renamed.append((gid, name)))
    assert [names[GID] for _ in range(100)] == ["01" * 16] * 100
    assert graph.asked == 1
    graph.known[OTHER] = NodeInfo("odometry", "/robot1", "/")
    assert [names[OTHER] for _ in range(100)] == ["/robot1/odometry"] * 100
    assert graph.asked == 2
    graph.known[GID] = NodeInfo("slam", "/", "/")
    graph.notify_changed()
    assert (names[GID], renamed, graph.asked) == ("/slam", [("01" * 16, "/slam")], 3)
    graph.notify_changed()
    assert graph.asked == 3


def test_many_publishers_stay_bounded():
    names = PublisherNames(Graph(), lambda gid, name: None)
    for i in range(3000):
        assert names[i.to_bytes(16, "big")] == f"{i:032x}"
    assert len(names) <= 1000


def test_a_forgotten_publisher_is_not_named_later():
    graph, renamed = Graph(), []
    names = PublisherNames(graph, lambda gid, name: renamed.append(gid))
    assert names[GID] == "01" * 16
    for i in range(1000):
        assert names[i.to_bytes(16, "big")] == f"{i:032x}"
    graph.known[GID] = NodeInfo("slam", "/", "/")
    graph.notify_changed()
    assert renamed == []
    assert names[GID] == "/slam"


def test_closed_it_listens_no_more():
    graph = Graph()
    names = PublisherNames(graph, lambda gid, name: None)
    assert names[GID] == "01" * 16
    names.close()
    graph.notify_changed()
    assert graph.asked == 1
