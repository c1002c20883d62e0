"""Publishers and subscriptions, on both middlewares."""

import time

import pytest

from geometry_msgs.msg import Twist, Vector3
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
)
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.subscription import Subscription
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger
from turtlewire.errors import CdrError

pytestmark = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])


def matched(context, publisher):
    assert context.wait_for_graph(lambda: publisher.get_subscription_count() > 0, 60_000_000_000)


def test_messages_arrive(context, node, spin_until):
    got = []
    subscription = node.create_subscription(Twist, "cmd_vel", got.append, 10)
    publisher = node.create_publisher(Twist, "cmd_vel", 10)
    matched(context, publisher)
    sent = Twist(linear=Vector3(x=1.5), angular=Vector3(z=-2))
    publisher.publish(sent)
    spin_until(lambda: got)
    assert got == [sent]
    assert (publisher.topic_name, subscription.topic_name) == ("/cmd_vel", "/cmd_vel")
    assert (publisher.topic, subscription.topic) == ("cmd_vel", "cmd_vel")  # as given
    assert (publisher.msg_type, subscription.msg_type) == (Twist, Twist)
    assert publisher.get_subscription_count() == 1
    assert subscription.get_publisher_count() == 1
    assert publisher in list(node.publishers)
    assert subscription in list(node.subscriptions)


def test_raw_bytes_both_ways(context, node, spin_until):
    got = []
    node.create_subscription(String, "chatter", got.append, 10, raw=True)
    publisher = node.create_publisher(String, "chatter", 10)
    matched(context, publisher)
    data = serialize_message(String(data="abc"))
    publisher.publish(data)
    publisher.publish(String(data="abc"))
    spin_until(lambda: len(got) == 2)
    for each in got:
        assert isinstance(each, bytes)
        assert each.rstrip(b"\0") == data.rstrip(b"\0")
        assert deserialize_message(each, String) == String(data="abc")


def test_message_info(context, node, spin_until):
    got = []

    def take(message, info):
        got.append((message.data, info))

    subscription = node.create_subscription(Int32, "number", take, 10)
    assert subscription._callback_type is Subscription.CallbackType.WithMessageInfo
    publisher = node.create_publisher(Int32, "number", 10)
    matched(context, publisher)
    before = time.time_ns()
    publisher.publish(Int32(data=4))
    spin_until(lambda: got)
    data, info = got[0]
    assert data == 4
    assert set(info) == {
        "source_timestamp",
        "received_timestamp",
        "publication_sequence_number",
        "reception_sequence_number",
    }
    assert (
        before - 1_000_000
        <= info["source_timestamp"]
        <= info["received_timestamp"] + 1_000_000
        <= time.time_ns() + 2_000_000
    )


class Callbacks:
    def __init__(self):
        self.got = []

    def one(self, message):
        self.got.append(1)

    def two(self, message, info):
        self.got.append(2)

    def one_and_more(self, message, *, extra=None):
        self.got.append(1)

    def __call__(self, message, info):
        self.got.append(2)

    @staticmethod
    def static(message):
        """Takes one."""

    async def later(self, message):
        self.got.append(1)


@pytest.mark.parametrize(
    ("callback", "arguments"),
    [
        (Callbacks().one, 1),
        (Callbacks().two, 2),
        (Callbacks().one_and_more, 1),
        (Callbacks(), 2),
        (Callbacks.static, 1),
        (Callbacks().later, 1),
        (lambda message: None, 1),
        (lambda message, info: None, 2),
        (lambda message, info=None: None, 1),
        (lambda *everything: None, 1),
        ([].append, 1),
        (print, 1),
    ],
)
def test_number_of_callback_arguments(node, callback, arguments):
    subscription = node.create_subscription(Int32, "number", callback, 10)
    assert subscription._callback_type.value == arguments - 1
    assert subscription.callback == callback


@pytest.mark.parametrize("callback", [lambda: None, lambda a, b, c: None])
def test_a_callback_with_another_number_of_arguments_is_refused(node, callback):
    with pytest.raises(
        RuntimeError, match="callback should be either be callable with one argument"
    ):
        node.create_subscription(Int32, "number", callback, 10)
    assert node.count_subscribers("number") == 0


@pytest.mark.parametrize("kind", ["publisher", "subscription", "client", "service"])
def test_endpoint_with_a_wrong_callback_group_is_not_announced(node, kind):
    create = {
        "publisher": lambda: node.create_publisher(Int32, "number", 10, callback_group=object()),
        "subscription": lambda: node.create_subscription(
            Int32, "number", print, 10, callback_group=object()
        ),
        "client": lambda: node.create_client(Trigger, "switch", callback_group=object()),
        "service": lambda: node.create_service(
            Trigger, "switch", lambda _, response: response, callback_group=object()
        ),
    }[kind]
    with pytest.raises(AttributeError, match="has no attribute 'add_entity'"):
        create()
    counts = [node.count_publishers("number"), node.count_subscribers("number")]
    counts += [node.count_clients("switch"), node.count_services("switch")]
    assert counts == [0, 0, 0, 0]


def test_without_subscriptions_only_the_first_message_is_encoded(context, node, monkeypatch):
    encoded = []
    monkeypatch.setattr(
        "rclpy.publisher.encode",
        lambda message: encoded.append(message) or b"\x00\x01\x00\x00\x01\x00\x00\x00",
    )
    volatile = node.create_publisher(Int32, "volatile", 10)
    for number in range(3):
        volatile.publish(Int32(data=number))
    assert [message.data for message in encoded] == [0]
    node.create_subscription(Int32, "volatile", lambda _: None, 10)
    matched(context, volatile)
    volatile.publish(Int32(data=3))
    assert [message.data for message in encoded] == [0, 3]


def test_an_invalid_message_is_an_error_although_nobody_listens(node):
    publisher = node.create_publisher(Int32, "number", 10)
    wrong = Int32()
    wrong.data = "1"
    for _ in range(2):
        with pytest.raises(CdrError, match="data"):
            publisher.publish(wrong)


@pytest.mark.parametrize(
    ("policies", "count"),
    [
        ({"durability": DurabilityPolicy.TRANSIENT_LOCAL}, 1),
        ({"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC}, 1),
        ({"liveliness": LivelinessPolicy.AUTOMATIC}, 0),
        ({"deadline": Duration(nanoseconds=1)}, 1),
        ({"deadline": Duration(nanoseconds=0)}, 0),
    ],
)
def test_messages_sent_without_subscriptions(node, monkeypatch, policies, count):
    publisher = node.create_publisher(Int32, "number", QoSProfile(depth=1, **policies))
    sent = []
    monkeypatch.setattr(publisher._wire, "publish", sent.append)
    publisher.publish(Int32(data=1))
    assert len(sent) == count


def test_unpublishable_values(context, node):
    publisher = node.create_publisher(Int32, "number", 10)
    for wrong in (String(), "text", 3, None, Int32):
        with pytest.raises(
            TypeError, match=r"^Expected <class 'std_msgs.msg._int32.Int32'>, got <class"
        ):
            publisher.publish(wrong)
    node.create_subscription(Int32, "number", lambda _: None, 10)
    matched(context, publisher)
    with pytest.raises(CdrError, match="data"):
        publisher.publish(Int32(data="three"))


@pytest.mark.parametrize("wrong", ["10", None, 1.5])
def test_quality_of_service_is_a_profile_or_a_depth(node, wrong):
    with pytest.raises(TypeError, match=r"^Expected QoSProfile or int, but received <class '"):
        node.create_publisher(Int32, "number", wrong)
    with pytest.raises(TypeError):
        node.create_subscription(Int32, "number", lambda _: None, wrong)


def test_depths(node):
    assert node.create_publisher(Int32, "number", 7).qos_profile == QoSProfile(
        depth=7, history=HistoryPolicy.KEEP_LAST
    )
    with pytest.raises(ValueError, match=r"^history depth must be greater than or equal to zero$"):
        node.create_publisher(Int32, "number", -1)


def test_types_are_checked(node):
    with pytest.raises(
        AttributeError,
        match=r"This might be a ROS 1 message type but it should be a ROS 2 message type",
    ):
        node.create_publisher(int, "number", 10)
    with pytest.raises(AttributeError):
        node.create_subscription("std_msgs/msg/Int32", "number", lambda _: None, 10)
    with pytest.raises(
        RuntimeError,
        match=r"The message type provided is not valid \(.*\), this might be a service or action",
    ):
        node.create_publisher(Trigger, "number", 10)


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("", "topic name must not be empty string:\n  ''\n   ^"),
        (
            "a?b",
            (
                "topic name must not contain characters other than alphanumerics, '_', '~', '{', "
                "or "
                "'}':\n  'a?b'\n    ^"
            ),
        ),
    ],
)
def test_names_are_checked(node, name, text):
    with pytest.raises(InvalidTopicNameException) as caught:
        node.create_publisher(Int32, name, 10)
    assert str(caught.value).startswith(f"Invalid topic name: {text}")
    with pytest.raises(InvalidTopicNameException):
        node.create_subscription(Int32, name, lambda _: None, 10)


def test_an_unknown_substitution_is_a_value_error(node):
    for make in (
        lambda: node.create_publisher(Int32, "a/{wrong}", 10),
        lambda: node.create_subscription(Int32, "a/{wrong}", lambda _: None, 10),
        lambda: node.create_client(Trigger, "a/{wrong}"),
        lambda: node.create_service(Trigger, "a/{wrong}", lambda _request, response: response),
    ):
        with pytest.raises(ValueError, match=r"unknown substitution: \{wrong\}"):
            make()


def test_destruction(node):
    publisher = node.create_publisher(Int32, "number", 10)
    subscription = node.create_subscription(Int32, "number", lambda _: None, 10)
    assert node.destroy_publisher(publisher)
    assert not node.destroy_publisher(publisher)
    assert node.destroy_subscription(subscription)
    assert not node.destroy_subscription(subscription)
    for use in (
        lambda: publisher.publish(Int32()),
        publisher.get_subscription_count,
        lambda: subscription.topic_name,
    ):
        with pytest.raises(
            InvalidHandle, match=r"^cannot use Destroyable because destruction was requested$"
        ):
            use()
    assert publisher not in list(node.publishers)
    assert subscription not in list(node.subscriptions)


def test_a_malformed_message_is_told_once_and_later_ones_arrive(context, node, spin_until, capfd):
    got = []
    node.create_subscription(String, "chatter", lambda message: got.append(message.data), 10)
    publisher = node.create_publisher(String, "chatter", 10)
    matched(context, publisher)
    for _ in range(3):
        publisher.publish(b"\x00\x01\x00\x00\xff\xff\xff\xff")
    publisher.publish(String(data="good"))
    spin_until(lambda: got)
    assert got == ["good"]
    assert capfd.readouterr().err.count("Ignoring a malformed message on topic '/chatter'") == 1


def test_wait_for_all_acked(context, node):
    publisher = node.create_publisher(Int32, "number", 10)
    node.create_subscription(Int32, "number", lambda _: None, 10)
    matched(context, publisher)
    publisher.publish(Int32())
    assert publisher.wait_for_all_acked(Duration(seconds=60))
    assert publisher.wait_for_all_acked()
    publisher.assert_liveliness()


LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def test_wait_for_message(node):
    node.create_publisher(Int32, "number", LATCHED).publish(Int32(data=6))
    came = wait_for_message(Int32, node, "number", qos_profile=LATCHED, time_to_wait=60)
    assert came == (True, Int32(data=6))
    start = time.monotonic()
    assert wait_for_message(Int32, node, "silence", time_to_wait=0.05) == (False, None)
    assert wait_for_message(Int32, node, "silence", time_to_wait=0) == (False, None)
    assert time.monotonic() - start >= 0.05
    assert not any(each.topic_name in ("/number", "/silence") for each in node.subscriptions)


def test_wait_for_message_in_a_callback(node, executor):
    node.create_publisher(Int32, "number", LATCHED).publish(Int32(data=6))
    results = []
    node.create_guard_condition(
        lambda: results.append(wait_for_message(Int32, node, "number", qos_profile=LATCHED))
    ).trigger()
    executor.spin_once(timeout_sec=60)
    assert results == [(True, Int32(data=6))]


def test_a_publisher_names_the_logger_of_its_node(context):
    node = Node("talker", namespace="robot", context=context)
    assert node.create_publisher(String, "chatter", 1).logger_name == "robot.talker"
