"""Many endpoints, many processes, and peers that do not keep up."""

from __future__ import annotations

import ctypes
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
from tests.needs import needs_cyclone_dds

from turtlewire.errors import WireError
from turtlewire.wire.base import Context, TypeId
from turtlewire.wire.cyclone import library
from turtlewire.wire.cyclone.announcer import ANNOUNCEMENT_INTERVAL_NS
from turtlewire.wire.graph import DISCOVERY_TOPIC, DISCOVERY_TYPE, unpack_discovery_info
from turtlewire.wire.qos import Durability, History, QoS

pytestmark = needs_cyclone_dds

PEERS = Path(__file__).parent / "peers"
STRING = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
MESSAGE = b"\x00\x01\x00\x00" + bytes(8)
LONG = 60_000_000_000


def test_a_thousand_endpoints_take_a_handful_of_announcements(contexts: list[Context]):
    announcements: list[int] = []
    complete = threading.Event()

    def on_announcement(data: bytes, _info) -> None:
        participant, nodes = unpack_discovery_info(data)
        if participant == contexts[0].gid:
            announcements.append(sum(len(node.writers) for node in nodes))
            if announcements[-1] == 1000:
                complete.set()

    everything = QoS(
        history=History.KEEP_ALL,
        durability=Durability.TRANSIENT_LOCAL,
        avoid_ros_namespace_conventions=True,
    )
    watcher = (
        contexts[1]
        .create_node("watcher")
        .create_subscription(DISCOVERY_TOPIC, DISCOVERY_TYPE, everything, on_announcement)
    )
    assert contexts[1].graph.wait_for(lambda: watcher.publisher_count() == 2, LONG)
    started = time.monotonic_ns()
    node = contexts[0].create_node("talker")
    for number in range(1000):
        node.create_publisher(f"/topic{number}", STRING, QoS())
    elapsed = time.monotonic_ns() - started
    assert complete.wait(60)
    assert len(announcements) <= 3 + elapsed // ANNOUNCEMENT_INTERVAL_NS


@contextmanager
def standing_still(context: Context, publisher):
    """Have a peer subscribe to what the publisher publishes, and take nothing."""
    with subprocess.Popen(
        [sys.executable, PEERS / "echo.py"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as peer:
        assert context.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG)
        peer.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            peer.send_signal(signal.SIGCONT)
        peer.communicate()


def publish_often(publisher, message: bytes) -> None:
    for _ in range(1000):
        publisher.publish(message)


def test_a_publisher_gives_up_on_a_subscription_that_stands_still(contexts: list[Context]):
    context = contexts[0]
    keep_all = QoS(history=History.KEEP_ALL)
    publisher = context.create_node("talker").create_publisher("/to_peer", STRING, keep_all)
    refused = r"/to_peer: not sent, a reliable subscription did not keep up for 1 s"
    with standing_still(context, publisher):
        with pytest.raises(WireError, match=refused) as caught:
            publish_often(publisher, MESSAGE + bytes(100_000))
        assert "KEEP_LAST" in caught.value.hint
    publisher.publish(MESSAGE)


def test_close_is_not_held_up_by_a_blocked_publisher(contexts: list[Context]):
    context = contexts[0]
    publisher = context.create_node("talker").create_publisher(
        "/to_peer", STRING, QoS(history=History.KEEP_ALL)
    )
    errors: list[str] = []

    def flood() -> None:
        try:
            while True:
                publisher.publish(MESSAGE + bytes(100_000))
        except WireError as error:
            errors.append(str(error))

    with standing_still(context, publisher):
        thread = threading.Thread(target=flood)
        thread.start()
        thread.join(0.3)
        context.close()
        thread.join(60)
        assert not thread.is_alive()
        assert len(errors) == 1


def test_threads_may_publish_take_and_close_at_the_same_time(contexts: list[Context]):
    """Nothing here may crash, hang, or raise anything but the error of a closed publisher."""
    talker, listener = (context.create_node("node") for context in contexts)
    unexpected: list[BaseException] = []
    closing = threading.Event()

    def guarded(work) -> None:
        try:
            while not closing.is_set():
                work()
        except WireError as error:
            if "closed" not in str(error):
                unexpected.append(error)
        except BaseException as error:
            unexpected.append(error)

    for round_number in range(10):
        closing.clear()
        publisher = talker.create_publisher("/busy", STRING, QoS())
        subscription = listener.create_subscription("/busy", STRING, QoS())
        by_callback = listener.create_subscription("/busy", STRING, QoS(), lambda *_: None)
        wait_set = listener.context.create_wait_set()
        wait_set.attach(subscription)
        works = [
            lambda: publisher.publish(MESSAGE),  # noqa: B023
            lambda: publisher.publish(MESSAGE),  # noqa: B023
            subscription.take,
            wait_set.wait,
        ]
        threads = [threading.Thread(target=guarded, args=(work,)) for work in works]
        for thread in threads:
            thread.start()
        threads[0].join(0.02)
        for entity in (
            (publisher, subscription, by_callback)
            if round_number % 2
            else (by_callback, subscription, publisher)
        ):
            entity.close()
        closing.set()
        wait_set.close()
        for thread in threads:
            thread.join(60)
            assert not thread.is_alive()
    assert unexpected == []


class Member:
    """One process of a crowd."""

    def __init__(self, *counts: int) -> None:
        command = [sys.executable, PEERS / "crowd.py", *map(str, counts)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.started = time.time()

    def next_time(self) -> float:
        """When it was up, or saw the next count."""
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        assert line, "it ended too early"
        return float(line.split()[1])

    def end(self) -> int:
        self.process.communicate()
        return self.process.returncode


@pytest.mark.slow
def test_fifty_processes_that_start_at_once_see_each_other(record_property):
    count = 50
    members = [Member(count) for _ in range(count)]
    try:
        up = max(member.next_time() for member in members)
        seen = max(member.next_time() for member in members)
    finally:
        codes = [member.end() for member in members]
    record_property("seconds from the last start until all are up", up - members[-1].started)
    record_property("seconds from the last start until all see all", seen - members[-1].started)
    assert codes == [0] * count


@pytest.mark.slow
def test_the_fiftieth_process_and_the_others_see_each_other(record_property):
    count = 50
    members = [Member(count - 1, count) for _ in range(count - 1)]
    try:
        for member in members:
            member.next_time()
            member.next_time()
        members.append(Member(count))
        members[-1].next_time()
        seen = max(member.next_time() for member in members)
    finally:
        codes = [member.end() for member in members]
    record_property("seconds from the last start until all see all", seen - members[-1].started)
    assert codes == [0] * count


def test_topics_that_come_and_go_leave_nothing(contexts: list[Context]):
    """A view of a robot that runs for days sees ever new names."""
    context = contexts[0]
    node = context.create_node("passing")
    count_children = ctypes.CDLL(library.LIBRARY.path).dds_get_children

    def come_and_go(number: int) -> int:
        publisher = node.create_publisher(f"/topic_{number}", STRING, QoS())
        subscription = node.create_subscription(f"/topic_{number}", STRING, QoS())
        subscription.close()
        publisher.close()
        return int(count_children(context._core.participant.handle, None, 0))

    assert come_and_go(1) == come_and_go(2)
