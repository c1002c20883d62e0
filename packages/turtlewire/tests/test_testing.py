"""`turtlewire.testing`, as a user's tests take it."""

import os
import socket
import threading

import pytest
from tests.programs import run_python

from turtlewire import testing, wire

NAMES = ("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOG_DIR", "ROS_STATIC_PEERS")


def test_a_domain_of_its_own_and_everything_as_before_afterwards(monkeypatch):
    monkeypatch.setenv("ROS_STATIC_PEERS", "192.0.2.1")
    monkeypatch.delenv("ROS_LOG_DIR")
    before = {name: os.environ.get(name) for name in NAMES}
    with testing.isolated_domain() as domain:
        assert os.environ["ROS_DOMAIN_ID"] == str(domain) != before["ROS_DOMAIN_ID"]
        assert os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
        assert "ROS_STATIC_PEERS" not in os.environ
        log = os.environ["ROS_LOG_DIR"]
        assert os.path.isdir(log)
        context = wire.open_context()
        assert context.domain_id == domain
        context.close()
    assert {name: os.environ.get(name) for name in NAMES} == before
    assert not os.path.exists(log)


def test_a_domain_is_reserved_for_one_process():
    code = "from turtlewire.testing import reserved_domain\nwith reserved_domain() as d: print(d)"
    with testing.reserved_domain() as mine, testing.reserved_domain() as other:
        child = run_python(code)
        assert len({mine, other, int(child.stdout)}) == 3


def test_a_domain_in_use_is_not_given(monkeypatch):
    with testing.reserved_domain() as first:
        pass
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as participant:
        participant.bind(("", 7410 + 250 * first))
        with testing.reserved_domain() as second:
            assert second != first
    monkeypatch.setattr(testing, "_LAST_DOMAIN", 0)
    with pytest.raises(RuntimeError, match="are in use"), testing.reserved_domain():
        pass


def test_a_filled_buffer():
    turned = (0.0, 0.0, 1.0, 0.0)
    buffer = testing.filled_buffer(
        [("world", "base"), ("base", "arm", (1.0, 2.0, 3.0)), ("arm", "hand", (1.0, 0, 0), turned)]
    )
    world_from_hand = buffer.lookup_transform("world", "hand")
    assert world_from_hand.translation == (2.0, 2.0, 3.0)
    assert world_from_hand.rotation == turned
    assert world_from_hand.stamp_ns is None
    moving = testing.filled_buffer([("world", "base", (1.0, 0.0, 0.0))], stamp_ns=5)
    assert moving.lookup_transform("world", "base").stamp_ns == 5
    with pytest.raises(ValueError, match="TF_SELF_TRANSFORM"):
        testing.filled_buffer([("world", "world")])


def test_waiting_ends_with_the_change():
    buffer = testing.filled_buffer([("world", "base")])
    still = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)

    def fill():
        buffer.set_static_transform("world", "one", *still)
        buffer.set_static_transform("world", "two", *still)

    thread = threading.Thread(target=fill)
    tested = []

    def both():
        if not tested:
            thread.start()  # the change comes after the first test at the earliest
        tested.append(threading.get_ident())
        return buffer.can_transform("one", "two")

    testing.wait_for(both, buffer)
    thread.join()
    assert set(tested) == {threading.get_ident()}
    testing.wait_for(lambda: True)


class Source:
    """Something that changes, and never does."""

    def __init__(self):
        self.listeners = []

    def on_change(self, listener):
        self.listeners.append(listener)
        return lambda: self.listeners.remove(listener)


def test_waiting_has_a_limit_and_leaves_no_listener():
    source = Source()

    def never():
        assert len(source.listeners) == 1
        return False

    with pytest.raises(TimeoutError, match=r"not met within 0\.01 s"):
        testing.wait_for(never, source, timeout_ns=10_000_000)
    assert source.listeners == []
