"""A page of the graph, nodes for it, and a page that is no browser."""

import contextlib
import json
import threading

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from turtlewire import msg, wire
from turtlewire.wire import conflicts
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS
from turtlewire_view.graph.graph_page import GraphPage
from turtlewire_view.graph.picture import Selection

LIMIT_S = 120
DEFAULT = QoS()


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


class Peer:
    """Collects messages, as a browser's page does."""

    def __init__(self, url):
        self._stack = contextlib.ExitStack()
        address = f"{url.replace('http', 'ws', 1)}live"
        self._socket = self._stack.enter_context(connect(address, max_size=None))
        self._news = threading.Condition()
        self._messages = []
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def send(self, kind, /, **fields):
        self._socket.send(json.dumps({"type": kind, **fields}))

    def wait_for(self, kind, accept=lambda message: True):
        """The newest message of a kind if it is accepted, perhaps one that is still to come."""

        def find():
            newest = next((each for each in self._messages[::-1] if each["type"] == kind), None)
            return newest if newest is not None and accept(newest) else None

        with self._news:
            assert self._news.wait_for(find, LIMIT_S), (kind, self._messages[-2:])
            return find()

    def wait_for_names(self, *names):
        """Wait until exactly these nodes are shown."""
        return self.wait_for("graph", lambda each: node_names(each) == [*names])

    def close(self):
        self._stack.close()
        self._thread.join()

    def _run(self):
        with contextlib.suppress(ConnectionClosed):
            for message in self._socket:
                with self._news:
                    self._messages.append(json.loads(message))
                    self._news.notify_all()


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
