"""Contexts and nodes of the in-process middleware, fresh for each test."""

import pytest

from geometry_msgs.msg import TransformStamped
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


@pytest.fixture(autouse=True)
def _local_middleware(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")


@pytest.fixture
def real_middleware(monkeypatch, _local_middleware):
    monkeypatch.delenv("RMW_IMPLEMENTATION")


@pytest.fixture
def context():
    with Context() as context:
        yield context


@pytest.fixture
def make_node(context):
    nodes = []

    def make(name="node", **arguments):
        nodes.append(Node(name, context=context, **arguments))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()


@pytest.fixture
def node(make_node):
    return make_node()


@pytest.fixture
def spin_until(context):
    """Spins a node in a single-threaded executor until a condition holds."""

    def spin_until(node, is_done):
        with SingleThreadedExecutor(context=context) as executor:
            executor.add_node(node)
            while not is_done():
                executor.spin_once(timeout_sec=60)

    return spin_until


@pytest.fixture
def stamped():
    def make(parent="world", child="robot", x=0.0, stamp_s=1):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = parent
        transform.header.stamp.sec = stamp_s
        transform.transform.translation.x = x
        return transform

    return make
