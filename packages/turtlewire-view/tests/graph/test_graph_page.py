"""The server of the page: the live graph, and topics that are measured on demand."""

import contextlib

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from turtlewire import msg
from turtlewire.wire.qos import Durability, QoS, Reliability

from .conftest import BEST_EFFORT, LATCHED, Peer, node_names


def text_message(text):
    return msg.serialize(msg.get_message("std_msgs/msg/String")(data=text))


def has(topic, field, expected):
    """A check of readings: whether a text is part of a field of a topic."""
    return lambda message: expected in message["topics"].get(topic, {field: ""})[field]


def test_a_page_gets_the_graph_and_its_changes(nodes, peer):
    nodes.node("talker")
    peer.wait_for_names("/talker")
    listener = nodes.context.create_node("listener")
    peer.wait_for_names("/listener", "/talker")
    listener.close()
    peer.wait_for_names("/talker")


def test_the_page_itself_is_not_part_of_the_graph(nodes, graph_page, peer):
    nodes.node("talker")
    peer.send("show", topics="all", debug=True, words="")
    message = peer.wait_for("graph", lambda each: "/talker" in node_names(each))
    assert not [name for name in node_names(message) if "turtlewire_graph" in name]


def test_a_mismatch_is_found_in_the_live_graph(nodes, peer):
    nodes.publisher("lidar", "/scan", BEST_EFFORT)
    nodes.subscription("slam", "/scan")

    def is_complete(message):  # an endpoint may arrive before the name of its node
        return message["graph"]["mismatches"] and node_names(message) == ["/lidar", "/slam"]

    message = peer.wait_for("graph", is_complete)
    (found,) = message["graph"]["mismatches"]
    assert (found["policy"], found["publishers"], found["subscriptions"]) == (
        "reliability", ["/lidar"], ["/slam"],
    )  # fmt: skip
    assert all(arrow[3] == [0] for arrow in message["arrows"])


def test_pages_choose_what_they_show(nodes, graph_page, peer):
    nodes.publisher("talker", "/chatter")
    nodes.publisher("camera", "/image")
    peer.wait_for_names("/camera", "/talker")
    with contextlib.closing(Peer(graph_page.url)) as other:
        peer.send("show", topics="none", debug=False, words="chatter")
        message = peer.wait_for_names("/talker")
        assert message["hidden"] >= 1
        assert [box[0] for box in message["boxes"]] == ["node"]
        assert other.wait_for("hello")["selection"] == {
            "topics": "all",
            "debug": False,
            "words": "",
        }
        other.wait_for_names("/camera", "/talker")


def test_a_topic_is_subscribed_only_while_a_page_measures_it(nodes, graph_page, peer):
    publisher = nodes.publisher("talker", "/chatter")
    peer.wait_for_names("/talker")
    assert nodes.subscribers("/chatter") == []
    peer.send("measure", topics=["/chatter"])
    assert nodes.wait_for(lambda: nodes.subscribers("/chatter"))
    (own,) = nodes.subscribers("/chatter")
    assert own.qos.reliability == Reliability.BEST_EFFORT
    assert own.qos.durability == Durability.VOLATILE
    assert nodes.wait_for(publisher.is_heard)
    with contextlib.closing(Peer(graph_page.url)) as other:
        other.send("measure", topics=["/chatter"])
        other.wait_for("readings", lambda each: "/chatter" in each["topics"])
        peer.send("measure", topics=[])
        peer.wait_for("readings", lambda each: not each["topics"])
        assert len(nodes.subscribers("/chatter")) == 1
    assert nodes.wait_for(lambda: not nodes.subscribers("/chatter"))


def test_a_measured_topic_has_a_rate_and_its_last_message(nodes, peer):
    publisher = nodes.publisher("talker", "/chatter")
    peer.wait_for_names("/talker")
    peer.send("measure", topics=["/chatter"])
    peer.wait_for("readings", has("/chatter", "note", "No message yet."))
    assert nodes.wait_for(publisher.is_heard)
    for number in range(3):  # a rate needs messages that arrive at different times
        publisher.publish(text_message(f"hello {number}"))
        readings = peer.wait_for("readings", has("/chatter", "value", f"hello {number}"))
    reading = readings["topics"]["/chatter"]
    assert reading["value"] == 'data: "hello 2"'
    assert reading["rate"] > 0
    assert reading["bandwidth"] > reading["rate"]
    assert reading["age"] >= 0


def test_a_topic_without_readings_has_a_reason(nodes, peer):
    nodes.publisher("map_server", "/map", LATCHED)
    nodes.subscription("planner", "/goal")
    large = nodes.publisher("camera", "/image")
    peer.wait_for_names("/camera", "/map_server", "/planner")
    peer.send("measure", topics=["/map", "/goal", "/image"])
    peer.wait_for("readings", has("/map", "note", "ros2 topic echo --once"))
    peer.wait_for("readings", has("/goal", "note", "No node publishes this topic."))
    assert nodes.wait_for(large.is_heard)
    large.publish(text_message("x" * 30_000))
    peer.wait_for("readings", has("/image", "note", "The message has 30,"))


def test_a_topic_that_is_published_later_is_measured_then(nodes, peer):
    peer.send("measure", topics=["/chatter"])
    peer.wait_for("readings", lambda each: each["topics"])
    publisher = nodes.publisher("talker", "/chatter")
    assert nodes.wait_for(publisher.is_heard)
    publisher.publish(text_message("late"))
    peer.wait_for("readings", has("/chatter", "value", "late"))


def test_a_topic_with_another_type_is_subscribed_again(nodes, peer):
    first = nodes.publisher("talker", "/chatter")
    peer.send("measure", topics=["/chatter"])
    assert nodes.wait_for(first.is_heard)
    first.close()
    number = nodes.publisher("counter", "/chatter", QoS(), "std_msgs/msg/Int32")
    assert nodes.wait_for(number.is_heard)
    number.publish(msg.serialize(msg.get_message("std_msgs/msg/Int32")(data=42)))
    peer.wait_for("readings", has("/chatter", "value", "data: 42"))


@pytest.mark.parametrize(
    ("command", "text"),
    [
        ({"type": "show", "topics": "some", "debug": False, "words": ""},
         "topics must be one of all, connected, none, not 'some'"),
        ({"type": "measure", "topics": [7]}, "topics must be a list of topic names"),
        ({"type": "measure", "topics": [f"/t{n}" for n in range(17)]},
         "A page measures at most 16 topics."),
        ({"type": "publish"}, "expected an object whose type is one of show, measure"),
    ],
)  # fmt: skip
def test_wrong_commands_are_answered(peer, command, text):
    kind = command.pop("type")
    peer.send(kind, **command)
    assert peer.wait_for("error")["text"] == text


@pytest.mark.parametrize("header", [{"Origin": "http://example.org"}, {"Host": "example.org"}])
def test_foreign_pages_are_refused(graph_page, header):
    address = f"{graph_page.url.replace('http', 'ws', 1)}live"
    with pytest.raises(InvalidStatus) as refused, connect(address, additional_headers=header):
        pass
    assert refused.value.response.status_code == 403
