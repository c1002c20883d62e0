"""Topics and services with PyPI's zenoh-ros2-sdk, over a router, in separate processes.

Zenoh subscribers without a liveliness token: bridges, storages, programs that know no ROS.
"""

from __future__ import annotations

import contextlib
import os
import socket
import struct
import subprocess
import sys
import threading
from contextlib import contextmanager
from pathlib import Path

import pytest
import zenoh

import rclpy
from std_msgs.msg import String
from turtlewire import msg
from turtlewire.wire import environment, open_context
from turtlewire.wire.base import ServiceTypes, TypeId
from turtlewire.wire.qos import QoS
from turtlewire.wire.zenoh.configuration import session_configuration

PEER = Path(__file__).parent / "peers" / "sdk.py"
ADD_TWO_INTS = "example_interfaces/srv/AddTwoInts"
LONG = 60_000_000_000


def type_id(name: str) -> TypeId:
    return TypeId(name, msg.type_hash(name))


STRING = type_id("std_msgs/msg/String")
ADD = ServiceTypes(
    ADD_TWO_INTS,
    type_id(f"{ADD_TWO_INTS}_Request"),
    type_id(f"{ADD_TWO_INTS}_Response"),
    msg.type_hash,
)


@pytest.fixture(scope="module")
def router():
    """The port of a router."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    override = f'listen/endpoints=["tcp/127.0.0.1:{port}"]'
    with subprocess.Popen(
        [sys.executable, "-c", "from rmw_zenoh_cpp.rmw_zenohd import main; main()"],
        stdout=subprocess.PIPE,
        text=True,
        env=os.environ | {"ZENOH_CONFIG_OVERRIDE": override},
    ) as process:
        assert process.stdout is not None
        try:
            assert process.stdout.readline().startswith("Started Zenoh router with id ")
            yield port
        finally:
            process.terminate()
    assert process.returncode == 0


@pytest.fixture
def context(router: int, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", f'connect/endpoints=["tcp/127.0.0.1:{router}"]')
    opened = open_context(middleware="rmw_zenoh_cpp")
    yield opened
    opened.close()


@contextmanager
def sdk(role: str, router: int):
    with subprocess.Popen(
        [sys.executable, "-W", "ignore", PEER, role, str(router), str(environment.domain_id())],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as peer:
        assert peer.stdout is not None
        try:
            yield peer, peer.stdout.readline().strip()
        finally:
            peer.kill()


def wait(context, entity) -> None:
    wait_set = context.create_wait_set()
    wait_set.attach(entity)
    assert wait_set.wait(LONG) == [entity]
    wait_set.close()


def test_their_publisher(context, router: int):
    subscription = context.create_node("here").create_subscription("/chatter", STRING, QoS())
    with sdk("publisher", router) as (peer, key):
        assert key == subscription.token.data_key
        assert context.graph.wait_for(lambda: subscription.publisher_count() == 1, LONG)
        assert context.graph.wait_for(
            lambda: "sdk_publisher" in [node.name for node in context.graph.nodes()], LONG
        )
        peer.stdin.write("once\n")
        peer.stdin.flush()
        wait(context, subscription)
        [(data, info)] = subscription.take()
    assert data[8:].startswith(b"from the sdk\0")
    assert len(info.publisher_gid) == 16


def test_their_subscriber(context, router: int):
    publisher = context.create_node("here").create_publisher("/chatter", STRING, QoS())
    with sdk("subscriber", router) as (peer, _):
        assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG)
        heard = threading.Event()

        def publish() -> None:
            # The sdk announces its subscription before it has subscribed.
            while not heard.wait(0.1):
                publisher.publish(b"\0\1\0\0\x06\0\0\0hello\0")

        publishing = threading.Thread(target=publish)
        publishing.start()
        line = peer.stdout.readline()
        heard.set()
        publishing.join()
    assert line == "hello\n"


def test_their_server(context, router: int):
    client = context.create_node("here").create_client("/add", ADD, QoS())
    with sdk("server", router):
        assert context.graph.wait_for(client.is_ready, LONG)
        wait_set = context.create_wait_set()
        wait_set.attach(client)
        sent = []
        while True:
            # The sdk announces its server before it answers.
            sent.append(client.send_request(b"\0\1\0\0" + struct.pack("<qq", 2, 40)))
            if wait_set.wait(500_000_000):
                break
        answered, response = client.take()[0]
    assert answered in sent
    assert struct.unpack_from("<q", response, 4) == (42,)


def test_their_client(context, router: int):
    service = context.create_node("here").create_service("/add", ADD, QoS())
    with sdk("client", router) as (peer, _):
        for _ in range(3):
            wait(context, service)
            [(request_id, request)] = service.take()
            total = sum(struct.unpack_from("<qq", request, 4))
            service.send_response(request_id, b"\0\1\0\0" + struct.pack("<q", total))
            assert peer.stdout.readline() == "42\n"


ZEROS = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)


def test_a_plain_subscriber_counts_as_a_listener():
    with (
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context,
        zenoh.open(session_configuration()) as peer,
    ):
        publisher = context.create_node("node").create_publisher("/chatter", ZEROS, QoS())
        for _ in range(2):
            assert not publisher.is_heard()
            with peer.declare_subscriber(publisher.token.data_key, lambda sample: None):
                assert context.graph.wait_for(publisher.is_heard, LONG)
                assert publisher.subscription_count() == 0
            assert context.graph.wait_for(lambda: not publisher.is_heard(), LONG)


def test_a_plain_subscriber_gets_what_a_node_publishes(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_zenoh_cpp")
    received = threading.Event()
    with (
        rclpy.Context() as context,
        zenoh.open(session_configuration()) as peer,
        peer.declare_subscriber("**", lambda sample: received.set()),
    ):
        node = rclpy.create_node("node", context=context)
        publisher = node.create_publisher(String, "chatter", 10)
        assert context.wire.graph.wait_for(publisher._wire.is_heard, LONG)
        publisher.publish(String(data="hello"))
        assert received.wait(60)


# What a subscription remembers of its publishers.


KIND = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
LONG_NS = 60_000_000_000


def test_publishers_that_come_and_go_leave_nothing():
    with contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as context:
        node, graph = context.create_node("node"), context.graph
        subscription = node.create_subscription("/name", KIND, QoS())
        wait_set = context.create_wait_set()
        wait_set.attach(subscription)
        for _ in range(2):
            publisher = node.create_publisher("/name", KIND, QoS())
            assert graph.wait_for(lambda: subscription.publisher_count() == 1, LONG_NS)
            publisher.publish(b"\0\1\0\0text")
            assert wait_set.wait(LONG_NS) == [subscription]
            assert len(subscription.take()) == 1
            assert list(subscription._last_numbers) == [publisher.gid]
            publisher.close()
            assert graph.wait_for(lambda: not subscription._last_numbers, LONG_NS)
