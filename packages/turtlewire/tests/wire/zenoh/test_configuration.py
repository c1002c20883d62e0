"""The configuration of sessions and routers, and the variables that change it.

Large messages in shared memory.
"""

from __future__ import annotations

import contextlib
import json
import re

import pytest
import zenoh
from tests.programs import run_python
from zenoh import shm

from turtlewire.errors import WireError
from turtlewire.wire import open_context, report
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS
from turtlewire.wire.zenoh.configuration import (
    SharedMemory,
    router_configuration,
    session_configuration,
)


def value(configuration, key: str):
    return json.loads(configuration.get_json(key))


def test_the_range_of_discovery(monkeypatch: pytest.MonkeyPatch):
    configuration = session_configuration()
    assert value(configuration, "listen/endpoints") == ["tcp/127.0.0.1:0"]
    assert value(configuration, "connect/endpoints") == ["tcp/127.0.0.1:7447"]
    assert value(configuration, "scouting/multicast/enabled") is True
    assert value(configuration, "scouting/multicast/interface") == "lo"
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET")
    monkeypatch.setenv("ROS_STATIC_PEERS", "10.0.0.7;robot.local;10.0.0.8:7448")
    configuration = session_configuration()
    assert value(configuration, "listen/endpoints") == ["tcp/0.0.0.0:0"]
    assert value(configuration, "scouting/multicast/interface") == "auto"
    assert value(configuration, "connect/endpoints")[1:] == [
        "tcp/10.0.0.7:7447",
        "tcp/robot.local:7447",
        "tcp/10.0.0.8:7448",
    ]
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT")
    assert value(session_configuration(), "connect/endpoints") == ["tcp/127.0.0.1:7447"]
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    configuration = session_configuration()
    assert value(configuration, "scouting/multicast/enabled") is False
    assert value(configuration, "connect/endpoints") == []


@pytest.mark.parametrize("peer", ["a b", "::1", "host:0", "host#iface=eth0"])
def test_a_static_peer_must_be_an_address(monkeypatch: pytest.MonkeyPatch, peer: str):
    monkeypatch.setenv("ROS_STATIC_PEERS", peer)
    with pytest.raises(WireError, match=f"ROS_STATIC_PEERS: '{peer}' is not an address"):
        session_configuration()


def test_the_router_stays_on_this_computer():
    configuration = router_configuration()
    assert value(configuration, "mode") == "router"
    assert value(configuration, "listen/endpoints") == ["tcp/127.0.0.1:7447"]


def test_single_values_are_overridden(monkeypatch: pytest.MonkeyPatch, capfd):
    monkeypatch.setenv(
        "ZENOH_CONFIG_OVERRIDE",
        'mode="client";connect/endpoints=["tcp/10.0.0.1:7447"]; no/such/key=1',
    )
    configuration = session_configuration()
    assert value(configuration, "mode") == "client"
    assert value(configuration, "connect/endpoints") == ["tcp/10.0.0.1:7447"]
    [line] = capfd.readouterr().err.splitlines()
    assert "Ignore the invalid configuration key-value pair: (no/such/key, 1)" in line


def test_shared_memory_is_sized_where_it_is_enabled(monkeypatch: pytest.MonkeyPatch):
    sizes = "transport/shared_memory/transport_optimization"
    monkeypatch.setenv("ZENOH_SHM_ALLOC_SIZE", "1000000")
    monkeypatch.setenv("ZENOH_SHM_MESSAGE_SIZE_THRESHOLD", "1024")
    assert value(session_configuration(), sizes)["pool_size"] == 48 * 1024 * 1024
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", "transport/shared_memory/enabled=true")
    for configuration in (session_configuration(), router_configuration()):
        assert value(configuration, sizes)["pool_size"] == 1_000_000
        assert value(configuration, sizes)["message_size_threshold"] == 1024


@pytest.mark.parametrize(
    ("variable", "text", "wanted"),
    [
        ("ZENOH_SHM_ALLOC_SIZE", "0", "a positive number of bytes"),
        ("ZENOH_SHM_ALLOC_SIZE", "-5", "a positive number of bytes"),
        ("ZENOH_SHM_MESSAGE_SIZE_THRESHOLD", "1000", "a power of 2"),
        ("ZENOH_SHM_MESSAGE_SIZE_THRESHOLD", "much", "a power of 2"),
    ],
)
def test_sizes_of_shared_memory_that_cannot_be(
    monkeypatch: pytest.MonkeyPatch, capfd, variable: str, text: str, wanted: str
):
    monkeypatch.setattr(report, "_said", set())
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", "transport/shared_memory/enabled=true")
    monkeypatch.setenv(variable, text)
    sizes = value(session_configuration(), "transport/shared_memory/transport_optimization")
    assert (sizes["pool_size"], sizes["message_size_threshold"]) == (48 * 1024 * 1024, 512)
    [line] = capfd.readouterr().err.splitlines()
    assert f"{variable} must be {wanted}, so it is ignored: {text}" in line


@pytest.mark.parametrize("make", [session_configuration, router_configuration])
@pytest.mark.parametrize("line_break", ["\n", "\r\n", "\u2028"])
def test_a_line_break_is_refused_because_rmw_zenoh_ignores_what_follows(
    monkeypatch: pytest.MonkeyPatch, make, line_break: str
):
    setting = f"access_control={{{line_break} enabled: true, default_permission: 'deny' }}"
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", f"\n{setting.replace(line_break, '')}\n")
    assert value(make(), "access_control/enabled") is True
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", setting)
    with pytest.raises(WireError, match="ZENOH_CONFIG_OVERRIDE has more than one line") as caught:
        make()
    assert "backslash" in caught.value.hint


def test_a_file_replaces_all(monkeypatch: pytest.MonkeyPatch, tmp_path):
    file = tmp_path / "session.json5"
    file.write_text('{ mode: "client", connect: { endpoints: ["tcp/10.0.0.1:7447"] } }')
    monkeypatch.setenv("ZENOH_SESSION_CONFIG_URI", str(file))
    assert value(session_configuration(), "mode") == "client"
    file.write_text("{ mode: nonsense")
    with pytest.raises(WireError, match=f"Invalid configuration file {file}") as caught:
        session_configuration()
    assert "ZENOH_SESSION_CONFIG_URI" in caught.value.hint
    assert ".rs:" not in caught.value.hint  # places in Zenoh's sources help nobody
    assert re.search(r"Zenoh says: line \d+: expected .+", caught.value.hint)
    assert "\n" not in caught.value.hint


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ('listen/endpoints=["tcp/192.0.2.1:7000"]', "TCP listener bound to tcp/192.0.2.1:7000"),
        ('connect/endpoints=["udpp/127.0.0.1:3"]', "not supported for udpp protocol"),
        (
            'mode="client";connect/endpoints=["tcp/127.0.0.1"]',
            "tcp/127.0.0.1 is not a reachable address",
        ),
        ('mode="client";connect/endpoints=["tls/a..b:7000"]', "tls/a..b:7000: no connection ("),
        (  # at the usual address, a router of another test might be found
            'mode="client";connect/endpoints=[];scouting/multicast/address="224.0.0.224:47017"',
            "connect/endpoints names no router",
        ),
    ],
)
def test_settings_that_open_no_session_are_named(monkeypatch: pytest.MonkeyPatch, override, said):
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", override)
    with pytest.raises(WireError, match=re.escape(said)) as caught:
        open_context(middleware="rmw_zenoh_cpp")
    assert "7447" not in str(caught.value)  # a router that may be missing is not at fault
    assert caught.value.hint


@pytest.mark.parametrize(
    ("variable", "value", "said"),
    [
        ("ZENOH_SESSION_CONFIG_URI", "/no/file", "Invalid configuration file /no/file. ZENOH_"),
        ("ZENOH_CONFIG_OVERRIDE", 'listen/endpoints=["tcp/192.0.2.1:7"]', "cannot open a Zenoh"),
        ("ROS_DOMAIN_ID", "kitchen", "'kitchen'. Set it to a number"),
    ],
)
def test_a_program_that_cannot_join_ends_with_one_line(
    monkeypatch: pytest.MonkeyPatch, variable, value, said
):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "rmw_zenoh_cpp")
    monkeypatch.setenv(variable, value)
    done = run_python("import rclpy; rclpy.init(); print('joined')", check=False)
    assert (done.returncode, done.stdout) == (1, "")
    [line] = done.stderr.splitlines()
    assert said in line


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
