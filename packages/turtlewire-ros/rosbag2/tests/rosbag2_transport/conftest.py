"""A node of the test's own, and recorders and players in processes."""

import contextlib
import signal
import threading

import pytest
from tests.places import ROS2

from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from turtlewire.bag import open_bag
from turtlewire.errors import BagError

LATCHED = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
DEEP = QoSProfile(depth=10_000)


class Peer:
    """A node that publishes, listens and calls, served by a thread."""

    def __init__(self):
        self.context = Context()
        self.context.init([])
        self.node = Node("peer", context=self.context)
        self.changed = threading.Condition()
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin)
        self._thread.start()

    def _spin(self):
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def close(self):
        self._executor.shutdown()
        self._thread.join()
        self.node.destroy_node()
        self.context.try_shutdown()

    def publisher(self, topic, qos=DEEP):
        return self.node.create_publisher(String, topic, qos)

    def heard(self, publisher, by=1):
        """Wait until this many subscriptions match a publisher."""
        graph = self.context.wire.graph
        assert graph.wait_for(lambda: publisher.get_subscription_count() >= by, 60_000_000_000)
        return publisher

    def listen(self, topic, qos=DEEP, type_=String):
        """Return a list to which the messages of a topic are appended."""
        got = []

        def take(message):
            with self.changed:
                got.append(message)
                self.changed.notify_all()

        self.node.create_subscription(type_, topic, take, qos)
        return got

    def wait_for(self, condition):
        with self.changed:
            assert self.changed.wait_for(condition, 60)

    def call(self, type_, service, **fields):
        """The answer of a service."""
        client = self.node.create_client(type_, service)
        try:
            assert client.wait_for_service(60)
            done = threading.Event()
            future = client.call_async(type_.Request(**fields))
            future.add_done_callback(lambda _: done.set())
            assert done.wait(60)
            return future.result()
        finally:
            self.node.destroy_client(client)


@pytest.fixture
def peer():
    peer = Peer()
    yield peer
    peer.close()


@pytest.fixture
def bag_verb(run, tmp_path):
    """Runs a verb of `ros2 bag` in the test's folder."""

    def start(*words, **options):
        return run(ROS2, "bag", *words, cwd=tmp_path, **options)

    return start


def end(program):
    """Press Ctrl-C; returns the exit status."""
    program.signal_group(signal.SIGINT)
    return program.wait()


def texts(path, topic):
    """The strings on a topic of a bag, in order of time."""
    with open_bag(path) as bag:
        if topic not in bag.topics:
            return []
        return [message.decode().data for message in bag.messages(topic)]


def wait_until_written(path, topic, count):
    """Wait until the file of a bag that is being recorded holds this many messages."""
    for _ in range(600):
        try:
            if len(texts(path, topic)) >= count:
                return
        except (BagError, FileNotFoundError):
            pass  # not begun yet
        threading.Event().wait(0.1)
    raise AssertionError(f"{texts(path, topic)} in {path}")


__all__ = ["DEEP", "LATCHED", "ROS2", "Peer", "end", "texts", "wait_until_written"]
