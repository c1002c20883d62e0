"""Graphs that tests look at, without a network."""

from __future__ import annotations

from turtlewire.wire.base import EndpointInfo, NodeInfo
from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view.graph.picture import Picture, read_graph

STRING = "std_msgs/msg/String"
DEFAULT = QoS()
BEST_EFFORT = QoS(depth=5, reliability=Reliability.BEST_EFFORT)
LATCHED = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)


class KnownGraph:
    """What :func:`read_graph` needs of a graph."""

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
