"""A server with real clients: `websockets` speaks the protocol from the other side."""

import contextlib
import json
import queue
import struct
import threading

import pytest
from websockets.sync.client import connect

from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from turtlewire import msg, wire
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire_view.foxglove import BridgeOptions, FoxgloveServer

LIMIT = 60


class Log:
    """Lines of the server."""

    def __init__(self):
        self.lines = []

    def info(self, message):
        self.lines.append(message)

    def warning(self, message):
        self.lines.append(f"warning: {message}")

    def warnings(self):
        return [line for line in self.lines if line.startswith("warning: ")]


class Client:
    """A client of the protocol; frames that it was not asked for are kept."""

    def __init__(self, socket):
        self.socket = socket
        self.frames = []

    def send(self, op, **fields):
        self.socket.send(json.dumps({"op": op, **fields}))

    def next_frame(self, matches):
        """The first frame for which ``matches`` is true."""
        for index, frame in enumerate(self.frames):
            if matches(frame):
                return self.frames.pop(index)
        while True:
            frame = self.socket.recv(LIMIT)
            frame = json.loads(frame) if isinstance(frame, str) else frame
            if matches(frame):
                return frame
            self.frames.append(frame)

    def next(self, op, matches=lambda frame: True):
        return self.next_frame(
            lambda frame: isinstance(frame, dict) and frame["op"] == op and matches(frame)
        )

    def next_binary(self, operation):
        return self.next_frame(lambda frame: isinstance(frame, bytes) and frame[0] == operation)

    def status(self):
        frame = self.next("status")
        return frame["level"], frame["message"]

    def channel(self, topic):
        """The channel of a topic, as soon as it is advertised."""
        return self._advertised("advertise", "channels", "topic", topic)

    def service(self, name):
        return self._advertised("advertiseServices", "services", "name", name)

    def _advertised(self, op, kind, key, name):
        def named(frame):
            return [each for each in frame[kind] if each[key] == name]

        frame = self.next(op, named)
        self.frames.append(frame)
        return named(frame)[0]

    def publish_on(self, topic):
        """Advertise channel 1, of texts as JSON."""
        channel = {"id": 1, "topic": topic, "encoding": "json", "schemaName": "std_msgs/String"}
        self.send("advertise", channels=[channel])

    def subscribe(self, topic, number):
        self.send(
            "subscribe", subscriptions=[{"id": number, "channelId": self.channel(topic)["id"]}]
        )

    def message(self, number):
        """The next message of a subscription: time in ns and CDR."""
        head = struct.pack("<BI", 1, number)
        frame = self.next_frame(lambda frame: isinstance(frame, bytes) and frame.startswith(head))
        return struct.unpack_from("<Q", frame, 5)[0], frame[13:]

    def text(self, number):
        """The text of the next message of a subscription."""
        return text_of(self.message(number)[1])

    def call(self, service_id, call_id, payload, encoding="json"):
        head = struct.pack("<BIII", 2, service_id, call_id, len(encoding))
        self.socket.send(head + encoding.encode() + payload)

    def sync(self):
        """Return when the server has done all that was asked before."""
        self.send("sync?")
        self.next("status", lambda frame: "'sync?'" in frame["message"])


def type_id(name):
    return TypeId(name, msg.type_hash(name))


class Robot:
    """Nodes of another participant."""

    def __init__(self):
        self.context = wire.open_context()
        self.node = self.context.create_node("robot")
        self.subscriptions = []

    def publisher(self, topic, type_name="std_msgs/msg/String", node=None, **qos):
        return (node or self.node).create_publisher(topic, type_id(type_name), QoS(**qos))

    def service(self, name, type_name):
        """A service that does not answer."""
        parts = [type_id(f"{type_name}_{part}") for part in ("Request", "Response")]
        types = ServiceTypes(type_name, *parts, msg.type_hash)
        return self.node.create_service(name, types, QoS())

    def say(self, publisher, data):
        """Publish a text."""
        publisher.publish(msg.serialize(msg.get_message("std_msgs/msg/String")(data=data)))

    def hear(self, topic, **qos):
        """A queue of the texts on a topic."""
        heard = queue.SimpleQueue()
        subscription = self.node.create_subscription(
            topic,
            type_id("std_msgs/msg/String"),
            QoS(**qos),
            lambda cdr, _: heard.put(text_of(cdr)),
        )
        self.subscriptions.append(subscription)
        return heard

    def wait_until(self, predicate):
        assert self.context.graph.wait_for(predicate, LIMIT * 1_000_000_000)


def text_of(cdr):
    return msg.deserialize(msg.get_message("std_msgs/msg/String"), cdr).data


@pytest.fixture
def ros():
    """Makes nodes of rclpy and spins them."""
    with contextlib.ExitStack() as stack:
        context = Context()
        context.init([])
        executor = SingleThreadedExecutor(context=context)
        thread = threading.Thread(target=spin, args=(executor,))

        def make(name, **options):
            node = Node(name, context=context, **options)
            executor.add_node(node)
            return node

        thread.start()
        stack.callback(context.try_shutdown)
        stack.callback(thread.join)
        stack.callback(executor.shutdown)
        yield make


def spin(executor):
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


@pytest.fixture
def log():
    return Log()


@pytest.fixture
def robot():
    robot = Robot()
    yield robot
    robot.context.close()


@pytest.fixture
def serve(log):
    """Starts servers; options are those of `BridgeOptions`."""
    started = []

    def start(find_share=None, **options):
        context = wire.open_context()
        started.append(context.close)
        node = context.create_node("foxglove_bridge")
        more = {} if find_share is None else {"find_share": find_share}
        server = FoxgloveServer(context, node, BridgeOptions(**{"port": 0, **options}), log, **more)
        started.append(server.close)
        server.graph = context.graph
        return server

    yield start
    for close in reversed(started):
        close()


@pytest.fixture
def client(serve):
    """Connects clients to a server, which is started with the first of them."""
    servers = []
    with contextlib.ExitStack() as stack:

        def connect_one(server=None, **options):
            if server is None:
                if not servers:
                    servers.append(serve())
                server = servers[0]
            options.setdefault("subprotocols", ["foxglove.sdk.v1"])
            connection = connect(server.url, compression=None, max_size=None, **options)
            return Client(stack.enter_context(connection))

        yield connect_one
