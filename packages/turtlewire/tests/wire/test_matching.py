"""Which publishers and subscriptions a middleware does not connect, and why."""

import pytest

from turtlewire.wire import conflicts
from turtlewire.wire.base import EndpointInfo
from turtlewire.wire.conflicts import obstacles
from turtlewire.wire.qos import INFINITE_NS, Durability, Liveliness, QoS, Reliability

SECOND = 10**9
DEFAULT = QoS()
BEST_EFFORT = QoS(reliability=Reliability.BEST_EFFORT)
LATCHED = QoS(durability=Durability.TRANSIENT_LOCAL)
MANUAL = QoS(liveliness=Liveliness.MANUAL_BY_TOPIC)


@pytest.fixture(autouse=True)
def _compares_qos(monkeypatch):
    """Let QoS keep endpoints apart, whatever the middleware of this machine is."""
    monkeypatch.setattr(conflicts, "compares_qos", lambda: True)


def endpoint(kind, qos=DEFAULT, type_name="std_msgs/msg/String", type_hash="RIHS01_a"):
    return EndpointInfo(kind, "/chatter", type_name, type_hash, None, bytes(16), qos)


def found(offered, requested):
    return [
        tuple(each)
        for each in obstacles(endpoint("publisher", offered), endpoint("subscription", requested))
    ]


@pytest.mark.parametrize(
    ("offered", "requested", "policy", "reason"),
    [
        (BEST_EFFORT, QoS(), "reliability",
         "it requests RELIABLE, but the publisher offers BEST_EFFORT"),
        (QoS(), LATCHED, "durability",
         "it requests TRANSIENT_LOCAL, but the publisher offers VOLATILE"),
        (QoS(), QoS(deadline_ns=SECOND), "deadline",
         "it requests a deadline of 1 s, but the publisher offers a deadline without limit"),
        (QoS(deadline_ns=2 * SECOND), QoS(deadline_ns=SECOND // 2), "deadline",
         "it requests a deadline of 0.5 s, but the publisher offers a deadline of 2 s"),
        (QoS(), MANUAL, "liveliness",
         "it requests MANUAL_BY_TOPIC, but the publisher offers AUTOMATIC"),
        (QoS(liveliness_lease_ns=INFINITE_NS), QoS(liveliness_lease_ns=SECOND), "liveliness",
         ("it requests a liveliness lease of 1 s, but the publisher offers a liveliness lease "
          "without limit")),
    ],
)  # fmt: skip
def test_a_policy_that_keeps_two_endpoints_apart_is_named(offered, requested, policy, reason):
    assert found(offered, requested) == [(policy, reason)]
    assert found(requested, offered) == []


def test_all_policies_are_named():
    assert [policy for policy, _ in found(BEST_EFFORT, LATCHED)] == ["reliability", "durability"]


def test_a_middleware_that_ignores_qos_connects_all(monkeypatch):
    monkeypatch.setattr(conflicts, "compares_qos", lambda: False)
    assert found(BEST_EFFORT, LATCHED) == []


def test_types_that_differ_are_named():
    publisher = endpoint("publisher", type_name="std_msgs/msg/Int32")
    ((policy, reason),) = obstacles(publisher, endpoint("subscription"))
    assert policy == "type"
    assert reason == "its type is std_msgs/msg/String, but the publisher's std_msgs/msg/Int32"


@pytest.mark.parametrize(("theirs", "expected"), [("RIHS01_b", ["type"]), ("", [])])
def test_definitions_that_differ_are_named_if_both_are_known(theirs, expected):
    reasons = obstacles(endpoint("publisher", type_hash=theirs), endpoint("subscription"))
    assert [each.policy for each in reasons] == expected
