"""Topics: advertised, on the wire only while they are wanted, latched, published by clients."""

import json
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from turtlewire import msg
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view.foxglove.schemas import schema

LATCHED = {"durability": Durability.TRANSIENT_LOCAL}


@pytest.fixture
def bridged(robot):
    """Subscriptions of a topic, as the robot sees them; only the server makes any."""
    return lambda topic: robot.context.graph.endpoints_of(topic, "subscription")


def test_the_server_says_first_what_it_can(client, log):
    one = client()
    info = json.loads(one.socket.recv())
    assert info["op"] == "serverInfo"
    assert info["supportedEncodings"] == ["cdr", "json"]
    assert {*info["capabilities"]} == {
        "assets",
        "clientPublish",
        "connectionGraph",
        "parameters",
        "parametersSubscribe",
        "services",
    }
    assert info["sessionId"] == json.loads(client().socket.recv())["sessionId"]
    assert one.socket.subprotocol == "foxglove.sdk.v1"
    assert sum("connected" in line for line in log.lines) == 2


def test_a_channel_has_the_definition_of_its_type_with_those_it_uses(client, robot):
    robot.publisher("/tf", "tf2_msgs/msg/TFMessage")
    channel = client().channel("/tf")
    assert channel["schemaName"] == "tf2_msgs/msg/TFMessage"
    assert (channel["encoding"], channel["schemaEncoding"]) == ("cdr", "ros2msg")
    assert channel["schema"] == schema("tf2_msgs/msg/TFMessage")
    for name in ("TransformStamped", "Transform", "Vector3", "Quaternion"):
        assert f"MSG: geometry_msgs/{name}\n" in channel["schema"]


def test_messages_come_as_they_are_with_the_time_of_their_arrival(client, robot):
    publisher = robot.publisher("/chatter", **LATCHED)
    before = time.time_ns()
    robot.say(publisher, "hello")
    one = client()
    one.subscribe("/chatter", 7)
    stamp, cdr = one.message(7)
    expected = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello"))
    assert cdr.rstrip(b"\0") == expected.rstrip(b"\0")  # the wire may pad them
    assert before <= stamp <= time.time_ns()


def test_a_topic_is_on_the_wire_only_while_a_client_wants_it(client, robot, bridged):
    publisher = robot.publisher("/chatter")
    one, two = client(), client()
    one.channel("/chatter")
    one.sync()
    assert not bridged("/chatter")
    one.subscribe("/chatter", 1)
    two.subscribe("/chatter", 2)
    robot.wait_until(lambda: publisher.subscription_count() == 1)
    two.sync()
    assert len(bridged("/chatter")) == 1
    robot.say(publisher, "both")
    assert one.text(1) == two.text(2) == "both"
    one.send("unsubscribe", subscriptionIds=[1])
    one.sync()
    assert len(bridged("/chatter")) == 1
    robot.say(publisher, "one")
    assert two.text(2) == "one"
    two.socket.close()
    robot.wait_until(lambda: publisher.subscription_count() == 0)


def test_each_client_gets_what_every_publisher_keeps(client, robot):
    nodes = [robot.context.create_node(f"static_{number}") for number in range(3)]
    publishers = [robot.publisher("/tf_like", node=node, depth=2, **LATCHED) for node in nodes]
    for number, publisher in enumerate(publishers):
        for again in "abc":
            robot.say(publisher, f"{number}{again}")
    kept = {f"{number}{again}" for number in range(3) for again in "bc"}
    one = client()
    one.subscribe("/tf_like", 1)
    assert {one.text(1) for _ in range(6)} == kept
    two = client()
    two.subscribe("/tf_like", 1)
    assert {two.text(1) for _ in range(6)} == kept
    two.send("unsubscribe", subscriptionIds=[1])
    two.sync()
    two.subscribe("/tf_like", 2)
    assert {two.text(2) for _ in range(6)} == kept
    robot.say(publishers[0], "live")
    assert one.text(1) == two.text(2) == "live"


@pytest.mark.parametrize("middleware", ["rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def test_latched_and_other_publishers_of_one_topic_are_all_heard_once(
    middleware, monkeypatch, request
):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    robot, client = (request.getfixturevalue(name) for name in ("robot", "client"))
    keeper = robot.publisher("/mixed", **LATCHED)
    robot.say(keeper, "kept")
    other = robot.publisher("/mixed", reliability=Reliability.BEST_EFFORT)
    one = client()
    one.subscribe("/mixed", 1)
    assert one.text(1) == "kept"
    robot.wait_until(lambda: other.subscription_count() >= 1)
    robot.say(other, "loose")
    assert one.text(1) == "loose"
    for again in ("second", "third"):
        robot.say(keeper, again)
        assert one.text(1) == again


def test_a_best_effort_publisher_that_comes_later_is_heard_too(client, robot):
    first = robot.publisher("/scan")
    one = client()
    one.subscribe("/scan", 1)
    robot.wait_until(lambda: first.subscription_count() == 1)
    second = robot.publisher("/scan", reliability=Reliability.BEST_EFFORT)
    robot.wait_until(lambda: second.subscription_count() == 1)
    robot.say(second, "best effort")
    assert one.text(1) == "best effort"


def test_topics_come_and_go(client, robot):
    one = client()
    publisher = robot.publisher("/chatter")
    number = one.channel("/chatter")["id"]
    one.subscribe("/chatter", 1)
    robot.wait_until(lambda: publisher.subscription_count() == 1)
    publisher.close()
    assert one.next("unadvertise") == {"op": "unadvertise", "channelIds": [number]}
    one.frames.clear()
    again = robot.publisher("/chatter", "std_msgs/msg/Int32")
    channel = one.channel("/chatter")
    assert channel["schemaName"] == "std_msgs/msg/Int32"
    assert channel["id"] != number
    again.close()


def test_hidden_topics_and_those_not_on_the_list_are_left_out(serve, client, robot):
    for topic in ("/camera/image", "/camera/_secret", "/other"):
        robot.publisher(topic)
    picky = client(serve(topic_whitelist=("/CAMERA/.*",)))
    picky.channel("/camera/image")
    everything = client(serve(include_hidden=True))
    everything.channel("/camera/_secret")
    everything.channel("/other")
    picky.sync()
    assert not any("_secret" in str(frame) or "/other" in str(frame) for frame in picky.frames)


def test_a_type_that_is_not_known_or_another_one_here_is_a_line(client, robot, log):
    no_hash = "RIHS01_" + 64 * "0"
    for topic, type_name in {"/odd": "odd_msgs/msg/Odd", "/old": "std_msgs/msg/Bool"}.items():
        robot.node.create_publisher(topic, TypeId(type_name, no_hash), QoS())
    robot.publisher("/chatter")
    client().channel("/chatter")
    unknown, other = sorted(log.warnings())
    assert unknown == (
        "warning: topic /odd is not offered: its type odd_msgs/msg/Odd is not installed here "
        "(unknown interface 'odd_msgs/msg/Odd')"
    )
    assert other == (
        "warning: topic /old is not offered: its publisher has another definition of "
        "std_msgs/msg/Bool than this installation"
    )


@pytest.mark.parametrize("encoding", ["cdr", "json"])
@pytest.mark.parametrize("schema_name", ["std_msgs/msg/String", "std_msgs/String"])
def test_clients_publish(client, robot, encoding, schema_name):
    heard = robot.hear("/said")
    one = client()
    one.send(
        "advertise",
        channels=[{"id": 3, "topic": "/said", "encoding": encoding, "schemaName": schema_name}],
    )
    (subscription,) = robot.subscriptions
    robot.wait_until(lambda: subscription.publisher_count() == 1)
    payload = (
        b'{"data": "hello"}'
        if encoding == "json"
        else msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello"))
    )
    one.socket.send(b"\x01\x03\0\0\0" + payload)
    assert heard.get(timeout=60) == "hello"
    one.send("unadvertise", channelIds=[3])
    robot.wait_until(lambda: subscription.publisher_count() == 0)


def test_publisher_of_a_client_ends_with_it(client, robot):
    robot.hear("/said")
    (subscription,) = robot.subscriptions
    one = client()
    one.publish_on("said")
    robot.wait_until(lambda: subscription.publisher_count() == 1)
    one.socket.close()
    robot.wait_until(lambda: subscription.publisher_count() == 0)


def test_a_subscription_that_wants_latched_messages_hears_clients(client, robot):
    heard = robot.hear("/map_like", **LATCHED)
    one = client()
    one.channel("/map_like")
    one.publish_on("/map_like")
    one.socket.send(b"\x01\x01\0\0\0" + b'{"data": "hello"}')
    assert heard.get(timeout=60) == "hello"


def test_clients_hear_each_other(client):
    speaker, listener = client(), client()
    speaker.publish_on("/talk")
    listener.subscribe("/talk", 5)
    listener.sync()
    speaker.socket.send(b"\x01\x01\0\0\0" + b'{"data": "over"}')
    assert listener.text(5) == "over"


@pytest.mark.parametrize(
    ("change", "answer"),
    [
        (
            {"topic": "/has space"},
            "'/has space' is not the name of a topic: topic name must not contain",
        ),
        ({"topic": "/x//y"}, "'/x//y' is not the name of a topic: "),
        ({"topic": "/secret"}, "client_topic_whitelist does not allow /secret"),
        ({"encoding": "protobuf"}, "/said: there is no encoding 'protobuf'; choose from cdr, json"),
        ({"schemaName": "std_msgs/Strang"}, "/said: unknown interface 'std_msgs/msg/Strang' Did"),
        ({"schemaName": "std_srvs/srv/Empty"}, "/said: 'std_srvs/srv/Empty' is not a message"),
        ({"schemaName": "x"}, "/said: "),
        ({"schemaName": 3}, '"schemaName" must be a string'),
        ({"topic": None}, '"topic" is missing'),
        ({"id": -1}, '"id" must be an integer from 0 to 4294967295'),
        ({"id": True}, '"id" must be an integer from 0 to 4294967295'),
    ],
)
def test_wrong_channels_are_refused_with_a_reason(serve, client, change, answer):
    one = client(serve(client_topic_whitelist=("(?!/secret).*",)))
    channel = {"id": 1, "topic": "/said", "encoding": "json", "schemaName": "std_msgs/String"}
    one.send("advertise", channels=[{**channel, **change}])
    level, message = one.status()
    assert level == 2
    assert message.startswith(answer)


def test_wrong_messages_are_refused_with_a_reason(client):
    one = client()
    json_channel = {"topic": "/a", "encoding": "json", "schemaName": "std_msgs/String"}
    one.send("advertise", channels=[{"id": 1, **json_channel}, {"id": 1, **json_channel}])
    assert one.status() == (2, "channel 1 is advertised already")
    one.send("advertise", channels=[{**json_channel, "id": 2, "encoding": "cdr"}])
    one.socket.send(b"\x01\x09\0\0\0{}")
    assert one.status() == (2, "there is no channel 9: advertise it first")
    one.socket.send(b'\x01\x01\0\0\0{"data": 3}')
    assert one.status()[1] == (
        "a message on /a was lost: std_msgs/msg/String.data: expected a string, got 3"
    )
    one.socket.send(b'\x01\x01\0\0\0{"dada": ""}')
    assert one.status()[1] == (
        "a message on /a was lost: std_msgs/msg/String has no field 'dada', it has data"
    )
    one.socket.send(b"\x01\x02\0\0\0junk")
    assert "are not a message (expected 00 01 00 00)" in one.status()[1]
    one.send("unadvertise", channelIds=[1, 8])
    assert one.status() == (1, "there is no channel 8")


def test_wrong_subscriptions_are_refused_with_a_reason(client, robot):
    robot.publisher("/chatter")
    one = client()
    number = one.channel("/chatter")["id"]
    one.send("subscribe", subscriptions=[{"id": 1, "channelId": number + 50}])
    assert one.status() == (1, f"there is no channel {number + 50}")
    one.send("subscribe", subscriptions=[{"id": 1, "channelId": number}] * 2)
    assert one.status() == (2, "there is a subscription 1 already")
    one.send("subscribe", subscriptions=[{"id": 2, "channelId": number}])
    assert one.status() == (1, "/chatter is subscribed to already")
    one.send("unsubscribe", subscriptionIds=[9])
    assert one.status() == (1, "there is no subscription 9")


@given(st.sampled_from(sorted(msg.interfaces())))
def test_every_type_has_a_definition(package):
    for kind, names in msg.interfaces()[package].items():
        for name in names:
            for full in {
                "msg": [f"{package}/msg/{name}"],
                "srv": [f"{package}/srv/{name}_{part}" for part in ("Request", "Response")],
                "action": [f"{package}/action/{name}_FeedbackMessage"],
            }[kind]:
                assert schema(full) is not None
