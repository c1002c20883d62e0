"""Events of QoS and overrides of QoS by parameters, over both middlewares."""

import importlib
import sys

import pytest
from tests.needs import needs_cyclone_dds

import rclpy
from rclpy import event_handler
from rclpy._qos import events
from rclpy.duration import Duration
from rclpy.event_handler import (
    PublisherEventCallbacks,
    QoSPublisherEventType,
    QoSSubscriptionEventType,
    SubscriptionEventCallbacks,
)
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.qos_overriding_options import (
    InvalidQosOverridesError,
    QosCallbackResult,
    QoSOverridingOptions,
)
from rclpy.waitable import Waitable
from std_msgs.msg import Int32, String
from turtlewire.wire.base import EventStatus

RELIABLE = QoSProfile(depth=1)
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


BOTH = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])


@BOTH
def test_matches(node, spin_until):
    seen = []
    publisher = node.create_publisher(
        String, "a", 1, event_callbacks=PublisherEventCallbacks(matched=seen.append)
    )
    subscription = node.create_subscription(String, "a", print, 1)
    spin_until(lambda: seen)
    assert seen.pop() == event_handler.QoSPublisherMatchedInfo(1, 1, 1, 1)
    node.destroy_subscription(subscription)
    spin_until(lambda: seen)
    assert seen.pop() == event_handler.QoSPublisherMatchedInfo(1, 0, 0, -1)
    node.destroy_publisher(publisher)


@BOTH
def test_unmatched_endpoints_are_reported(node, executor, spin_until):
    offered, requested = [], []
    publisher = node.create_publisher(
        String,
        "a",
        BEST_EFFORT,
        event_callbacks=PublisherEventCallbacks(incompatible_qos=offered.append),
    )
    callbacks = SubscriptionEventCallbacks(incompatible_qos=requested.append)
    got = []
    node.create_subscription(String, "a", got.append, RELIABLE, event_callbacks=callbacks)
    spin_until(lambda: offered and requested)
    publisher.publish(String())
    executor.spin_once(timeout_sec=0)
    assert got == []
    assert (
        offered
        == requested
        == [event_handler.QoSOfferedIncompatibleQoSInfo(1, 1, QoSPolicyKind.RELIABILITY)]
    )
    text = "rmw_qos_policy_kind_t.RMW_QOS_POLICY_RELIABILITY"
    assert str(offered[0].last_policy_kind) == text


@BOTH
def test_ros_2s_warnings(node, spin_until, capfd):
    node.create_publisher(String, "a", RELIABLE)
    late = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(String, "a", print, late)
    lines = []

    def both():
        lines.extend(capfd.readouterr().err.splitlines())
        return len(lines) == 2

    spin_until(both)
    texts = sorted(line.partition("[tested]: ")[2] for line in lines)
    assert texts == [
        (
            "New publisher discovered on topic 'a', offering incompatible QoS. No messages will "
            "be received from it. "
            "Last incompatible policy: DURABILITY"
        ),
        (
            "New subscription discovered on topic 'a', requesting incompatible QoS. No messages "
            "will be sent to it. "
            "Last incompatible policy: DURABILITY"
        ),
    ]
    assert all(line.startswith("[WARN] ") for line in lines)


@BOTH
def test_the_warnings_can_be_switched_off(node, spin_until, capfd):
    matched = []
    node.create_publisher(
        String,
        "a",
        BEST_EFFORT,
        event_callbacks=PublisherEventCallbacks(use_default_callbacks=False),
    )
    callbacks = SubscriptionEventCallbacks(use_default_callbacks=False)
    node.create_subscription(String, "a", print, RELIABLE, event_callbacks=callbacks)
    node.create_publisher(
        String, "b", 1, event_callbacks=PublisherEventCallbacks(matched=matched.append)
    )
    node.create_subscription(String, "b", print, 1)
    spin_until(lambda: matched)
    assert capfd.readouterr().err == ""


@BOTH
def test_handlers_of_events_that_never_happen_are_accepted(node, spin_until):
    called = []
    node.create_publisher(
        String, "a", 1, event_callbacks=PublisherEventCallbacks(incompatible_type=called.append)
    )
    matched = []
    node.create_subscription(
        String,
        "a",
        print,
        1,
        event_callbacks=SubscriptionEventCallbacks(
            incompatible_type=called.append, matched=matched.append
        ),
    )
    node.create_publisher(Int32, "a", 1)
    spin_until(lambda: matched)
    assert called == []


@BOTH
def test_handlers_go_with_their_endpoint(node, spin_until):
    publisher = node.create_publisher(String, "a", 1)
    (handler,) = publisher.event_handlers
    publisher.destroy()
    assert handler._destroyed


def overridden(context, *rules, **keywords):
    words = ["--ros-args", *(word for rule in rules for word in ("-p", rule))]
    return Node("n", context=context, cli_args=words, start_parameter_services=False, **keywords)


def test_overrides(context):
    node = overridden(
        context,
        "qos_overrides./a.publisher.depth:=7",
        "qos_overrides./a.publisher.reliability:=best_effort",
        "qos_overrides./a.subscription_x.history:=keep_all",
    )
    given = QoSProfile(depth=1)
    publisher = node.create_publisher(
        String, "a", given, qos_overriding_options=QoSOverridingOptions.with_default_policies()
    )
    options = QoSOverridingOptions.with_default_policies(entity_id="x")
    subscription = node.create_subscription(
        String, "a", print, given, qos_overriding_options=options
    )
    assert (publisher.qos_profile.depth, publisher.qos_profile.reliability) == (
        7,
        ReliabilityPolicy.BEST_EFFORT,
    )
    assert subscription.qos_profile.history is HistoryPolicy.KEEP_ALL
    assert given == QoSProfile(depth=1)
    names = node.list_parameters(["qos_overrides"], 0).names
    assert names == [
        f"qos_overrides./a.{entity}.{policy}"
        for entity in ("publisher", "subscription_x")
        for policy in ("history", "depth", "reliability")
    ]
    described = node.describe_parameter("qos_overrides./a.subscription_x.depth")
    assert (described.read_only, described.description) == (
        True,
        "depth for subscription `/a` with id `x`",
    )
    again = node.create_publisher(
        String, "a", given, qos_overriding_options=QoSOverridingOptions.with_default_policies()
    )
    assert again.qos_profile.depth == 7


def test_every_policy_can_be_overridden(context):
    node = overridden(
        context,
        "qos_overrides./a.publisher.deadline:=1000000000",
        "qos_overrides./a.publisher.durability:=transient_local",
    )
    policies = [kind for kind in QoSPolicyKind if kind is not QoSPolicyKind.INVALID]
    for create in (
        lambda options: node.create_publisher(String, "a", 1, qos_overriding_options=options),
        lambda options: node.create_subscription(
            String, "b", print, 1, qos_overriding_options=options
        ),
    ):
        create(QoSOverridingOptions(policies))
    names = node.list_parameters(["qos_overrides"], 0).names
    assert len(names) == 2 * len(policies) - 1
    assert "qos_overrides./b.subscription.lifespan" not in names
    (publisher,) = [each for each in node.publishers if each.topic_name == "/a"]
    assert publisher.qos_profile.deadline.nanoseconds == 10**9
    assert publisher.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL


def test_wrong_overrides(context):
    node = overridden(
        context,
        "qos_overrides./a.publisher.reliability:=maybe",
        "qos_overrides./b.publisher.depth:=deep",
    )
    options = QoSOverridingOptions.with_default_policies()
    with pytest.raises(
        ValueError,
        match=r"^Unexpected QoS override for policy `reliability`: `maybe`; choose from "
        r"system_default, reliable",
    ):
        node.create_publisher(String, "a", 1, qos_overriding_options=options)
    with pytest.raises(InvalidParameterTypeException):
        node.create_publisher(String, "b", 1, qos_overriding_options=options)
    refusing = QoSOverridingOptions.with_default_policies(
        callback=lambda qos: QosCallbackResult(successful=False, reason=f"{qos.depth}")
    )
    with pytest.raises(
        InvalidQosOverridesError,
        match=r"^Provided QoS overrides for publisher `/c` with id `None`, are not valid: 3$",
    ):
        node.create_publisher(String, "c", 3, qos_overriding_options=refusing)


@needs_cyclone_dds
@pytest.mark.parametrize("middleware", ["rmw_cyclonedds_cpp"])
def test_a_publisher_misses_its_deadline_without_a_subscription(node, executor):
    missed = rclpy.task.Future()
    publisher = node.create_publisher(
        String,
        "promised",
        QoSProfile(depth=1, deadline=Duration(nanoseconds=50_000_000)),
        event_callbacks=PublisherEventCallbacks(deadline=missed.set_result),
    )
    publisher.publish(String())
    executor.spin_until_future_complete(missed, timeout_sec=60)
    assert missed.result().total_count >= 1


def test_a_liveliness_change_tells_the_living_from_the_others():
    """``EventStatus`` has those that are not alive as its total, the living as its current
    count.
    """
    status = EventStatus(
        total_count=1, total_count_change=-2, current_count=3, current_count_change=4
    )
    info = events._liveliness(status)
    assert (info.alive_count, info.alive_count_change) == (3, 4)
    assert (info.not_alive_count, info.not_alive_count_change) == (1, -2)


@BOTH
def test_a_handler_is_a_waitable(node, spin_until):
    seen = []
    publisher = node.create_publisher(
        String, "a", 1, event_callbacks=PublisherEventCallbacks(matched=seen.append)
    )
    handler = next(
        each
        for each in publisher.event_handlers
        if each.event_type is QoSPublisherEventType.RCL_PUBLISHER_MATCHED
    )
    assert isinstance(handler, Waitable)
    assert repr(handler.get_num_entities()) == "<NumberOfEntities(0, 0, 0, 0, 0, 1)>"
    assert handler.take_data() is None
    with pytest.warns(DeprecationWarning, match="use EventHandler"):
        former = event_handler.QoSEventHandler(
            callback_group=handler.callback_group,
            callback=seen.append,
            event_type=QoSPublisherEventType.RCL_PUBLISHER_MATCHED,
            parent_impl=publisher.handle,
        )
    former.destroy()


@BOTH
def test_an_event_callback_may_be_async(node, spin_until):
    seen = []

    async def matched(info):
        seen.append(info.current_count)

    callbacks = SubscriptionEventCallbacks(matched=matched)
    node.create_subscription(String, "a", print, 1, event_callbacks=callbacks)
    node.create_publisher(String, "a", 1)
    spin_until(lambda: seen)
    assert seen == [1]


def test_the_former_module_of_events(monkeypatch):
    monkeypatch.delitem(sys.modules, "rclpy.qos_event", raising=False)
    with pytest.warns(UserWarning, match="import 'event_handler' instead"):
        qos_event = importlib.import_module("rclpy.qos_event")
    for name in qos_event.__all__:
        assert getattr(qos_event, name) is getattr(event_handler, name)
    for name in ("QoSRequestedDeadlineMissedInfo", "QoSOfferedDeadlineMissedInfo"):
        assert getattr(qos_event, name)(total_count=3, total_count_change=1) == (3, 1)


@BOTH
def test_a_program_may_make_a_handler_itself(node, spin_until):
    published, subscribed = [], []
    publisher = node.create_publisher(String, "a", 1)
    subscription = node.create_subscription(String, "b", print, 1)
    for endpoint, event_type, seen in (
        (publisher, QoSPublisherEventType.RCL_PUBLISHER_MATCHED, published),
        (subscription, QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED, subscribed),
    ):
        node.add_waitable(
            event_handler.EventHandler(
                callback_group=node.default_callback_group,
                callback=seen.append,
                event_type=event_type,
                parent_impl=endpoint.handle,
            )
        )
    node.create_subscription(String, "a", print, 1)
    node.create_publisher(String, "b", 1)
    spin_until(lambda: published and subscribed)
    assert type(published[0]) is event_handler.QoSPublisherMatchedInfo
    assert type(subscribed[0]) is event_handler.QoSSubscriptionMatchedInfo
    assert published[0].current_count == subscribed[0].current_count == 1
