"""Large messages in shared memory."""

from __future__ import annotations

import contextlib

import pytest
import zenoh
from zenoh import shm

from turtlewire.wire import open_context, report
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS
from turtlewire.wire.zenoh.configuration import session_configuration
from turtlewire.wire.zenoh.shared_memory import SharedMemory

KIND = TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64)
LONG_NS = 60_000_000_000
LARGE = b"\0\1\0\0" + bytes(range(256)) * 1000


@pytest.fixture
def enabled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", "transport/shared_memory/enabled=true")
    monkeypatch.setattr(report, "_said", set())


def make(**sizes: int) -> SharedMemory:
    configuration: zenoh.Config = session_configuration()
    for key, size in sizes.items():
        path = f"transport/shared_memory/transport_optimization/{key}"
        configuration.insert_json5(path, str(size))
    return SharedMemory(configuration)


@pytest.mark.usefixtures("enabled")
def test_a_large_message_is_placed_and_a_small_one_is_not():
    memory = make()
    placed = memory.placed(LARGE)
    assert isinstance(placed, shm.ZShmMut)
    assert bytes(placed) == LARGE
    small = bytes(1000)
    assert memory.placed(small) is small
    memory.close()
    assert memory.placed(LARGE) is LARGE


@pytest.mark.usefixtures("enabled")
def test_the_threshold_of_the_configuration_counts():
    memory = make(message_size_threshold=1 << 20)
    assert memory.placed(LARGE) is LARGE
    memory.close()


def test_nothing_is_placed_unless_it_is_enabled():
    assert make().placed(LARGE) is LARGE


@pytest.mark.usefixtures("enabled")
def test_a_full_pool_lends_again_what_has_been_freed():
    memory = make(pool_size=len(LARGE) * 3)
    held = [memory.placed(LARGE) for _ in range(4)]
    assert held[-1] is LARGE
    held.clear()
    assert isinstance(memory.placed(LARGE), shm.ZShmMut)
    memory.close()


@pytest.mark.usefixtures("enabled")
def test_a_pool_that_cannot_be_made_is_told_once(capfd):
    memory = make(pool_size=1 << 60)
    assert memory.placed(LARGE) is LARGE
    assert memory.placed(LARGE) is LARGE
    [line] = capfd.readouterr().err.splitlines()
    assert "messages are copied: Unable to create SHM" in line


@pytest.mark.usefixtures("enabled")
@pytest.mark.parametrize("durability", [Durability.VOLATILE, Durability.TRANSIENT_LOCAL])
def test_a_message_arrives_with_all_its_bytes(durability: Durability):
    qos = QoS(durability=durability)
    with (
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as sender,
        contextlib.closing(open_context(middleware="rmw_zenoh_cpp")) as receiver,
    ):
        publisher = sender.create_node("sender").create_publisher("/name", KIND, qos)
        subscription = receiver.create_node("receiver").create_subscription("/name", KIND, qos)
        wait_set = receiver.create_wait_set()
        wait_set.attach(subscription)
        assert sender.graph.wait_for(lambda: publisher.subscription_count() == 1, LONG_NS)
        publisher.publish(LARGE)
        assert wait_set.wait(LONG_NS) == [subscription]
        [(cdr, _)] = subscription.take()
        assert cdr == LARGE
        # What is kept for late subscriptions stays out of the pool.
        has_pool = sender._core.memory._provider is not None
        assert has_pool == (durability == Durability.VOLATILE)
