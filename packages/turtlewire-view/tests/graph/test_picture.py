"""What the graph holds, and which part of it is shown."""

from __future__ import annotations

import pytest

from turtlewire.wire.qos import QoS
from turtlewire_view.graph.diagram import make_diagram
from turtlewire_view.graph.picture import UNKNOWN, Selection, read_graph, select

from .pictures import BEST_EFFORT, STRING, KnownGraph, robot


def shown(graph, *words):
    picture = select(graph.picture(), Selection(*words))
    return [*picture.nodes], [*picture.topics]


def arrows(picture, *, with_topics=True):
    boxes, found = make_diagram(picture, with_topics=with_topics)
    return {(boxes[each.source].name, boxes[each.target].name): each for each in found}


def test_each_mistake_is_a_mismatch_with_its_policy():
    found = robot().picture().mismatches
    assert [(each.topic, each.policy, each.publishers, each.subscriptions) for each in found] == [
        ("/cmd_vel", "type", ("/planner",), ("/wheels",)),
        ("/map", "durability", ("/slam",), ("/planner",)),
        ("/scan", "reliability", ("/lidar",), ("/slam",)),
    ]
    assert found[2].reason == "it requests RELIABLE, but the publisher offers BEST_EFFORT"


def test_endpoints_of_equal_qos_share_a_mismatch():
    graph = KnownGraph()
    for number in range(3):
        graph.node(f"/talker{number}", [("/chatter", BEST_EFFORT, STRING)])
        graph.node(f"/listener{number}", (), ["/chatter"])
    (found,) = graph.picture().mismatches
    assert found.publishers == ("/talker0", "/talker1", "/talker2")
    assert found.subscriptions == ("/listener0", "/listener1", "/listener2")


def test_services_and_topics_of_other_systems_are_left_out():
    graph = KnownGraph().node("/talker", ["/chatter"])
    graph.add("subscription", "rq/talker/get_parametersRequest", STRING, graph.nodes()[0])
    graph.add("publisher", "/raw", STRING, None, QoS(avoid_ros_namespace_conventions=True))
    assert [*graph.picture().topics] == ["/chatter"]


def test_endpoints_without_a_node_belong_to_an_unknown_one():
    graph = KnownGraph()
    graph.add("publisher", "/chatter", STRING, None)
    assert graph.picture().nodes == {UNKNOWN: 1}


def test_nodes_of_one_name_are_counted():
    picture = KnownGraph().node("/twin").node("/twin").picture()
    assert picture.nodes == {"/twin": 2}
    assert make_diagram(picture, with_topics=True).boxes[0].note == "2 nodes have this name"


def test_the_page_does_not_show_itself():
    graph = KnownGraph().node("/_page", (), ["/chatter"]).node("/talker", ["/chatter"])
    picture = read_graph(graph, 7, "/_page")
    assert [*picture.nodes] == ["/talker"]
    assert [each.node for each in picture.endpoints] == ["/talker"]


def test_debugging_topics_and_nodes_are_hidden_by_default():
    nodes, topics = shown(robot())
    assert nodes == ["/lidar", "/planner", "/robot2/camera", "/slam", "/wheels"]
    assert topics == ["/cmd_vel", "/map", "/robot2/image", "/scan"]
    nodes, topics = shown(robot(), "all", True)
    assert "/_hidden" in nodes
    assert {"/rosout", "/parameter_events"} <= {*topics}


@pytest.mark.parametrize(
    "name", ["/rviz2", "/rqt_gui_py_node_7", "/turtlewire_view_12", "/launch_ros_99",
             "/transform_listener_impl_5f", "/foxglove_bridge"],
)  # fmt: skip
def test_nodes_of_tools_belong_to_debugging(name):
    graph = KnownGraph().node(name, ["/chatter"])
    assert shown(graph) == ([], [])
    assert shown(graph, "all", True) == ([name], ["/chatter"])


def test_connected_topics_have_a_publisher_and_a_subscription():
    assert shown(robot(), "connected")[1] == ["/cmd_vel", "/map", "/scan"]


def test_words_choose_names_and_their_neighbours():
    assert shown(robot(), "all", False, "map") == (["/planner", "/slam"], ["/map"])
    assert shown(robot(), "all", False, "lidar /robot2/") == (
        ["/lidar", "/robot2/camera"],
        ["/robot2/image", "/scan"],
    )
    assert shown(robot(), "all", False, "scan -slam") == (["/lidar"], ["/scan"])
    assert shown(robot(), "all", False, "-") == shown(robot())
    assert shown(robot(), "all", False, "no_such_name") == ([], [])


def test_mismatches_with_hidden_nodes_are_hidden():
    picture = select(robot().picture(), Selection(words="-slam"))
    assert [each.topic for each in picture.mismatches] == ["/cmd_vel"]


def test_arrows_lead_from_publishers_over_topics_to_subscriptions():
    picture = select(robot().picture(), Selection())
    found = arrows(picture)
    assert ("/lidar", "/scan") in found
    assert ("/scan", "/slam") in found
    assert {names for names, each in found.items() if each.mismatches} == {
        ("/lidar", "/scan"), ("/scan", "/slam"),
        ("/slam", "/map"), ("/map", "/planner"),
        ("/planner", "/cmd_vel"), ("/cmd_vel", "/wheels"),
    }  # fmt: skip


def test_without_topics_arrows_lead_from_node_to_node():
    graph = robot().node("/echo", ["/cmd_vel"], ["/cmd_vel"])
    picture = select(graph.picture(), Selection("none"))
    found = arrows(picture, with_topics=False)
    assert found["/lidar", "/slam"].topics == ("/scan",)
    assert [picture.mismatches[n].policy for n in found["/lidar", "/slam"].mismatches] == [
        "reliability"
    ]
    assert found["/echo", "/echo"].topics == ("/cmd_vel",)
    assert found["/planner", "/echo"].mismatches == ()


def test_a_topic_of_two_types_is_noted():
    boxes = make_diagram(robot().picture(), with_topics=True).boxes
    (note,) = [box.note for box in boxes if box.name == "/cmd_vel"]
    assert note == "2 types: std_msgs/msg/Int32, std_msgs/msg/String"
