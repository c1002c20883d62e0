"""The positions of boxes and the paths of arrows.

What the graph holds, and which part of it is shown.
"""

import itertools
import re

import pytest

from turtlewire.wire.qos import QoS
from turtlewire_view.graph.layers import make_layers
from turtlewire_view.graph.layout import Arrow, Box, Diagram, make_diagram, make_layout
from turtlewire_view.graph.picture import UNKNOWN, Selection, read_graph, select

from .conftest import BEST_EFFORT, STRING, KnownGraph, large, robot


def placed(graph, topics="all"):
    picture = select(graph.picture(), Selection(topics))
    diagram = make_diagram(picture, with_topics=topics != "none")
    return diagram, make_layout(diagram)


def overlaps(layout):
    """Pairs of boxes that share a point, found in the order of their left ends."""
    boxes = sorted(layout.boxes)
    return [
        (one.label, other.label)
        for n, one in enumerate(boxes)
        for other in itertools.takewhile(
            lambda box, end=one.x + one.width: box.x < end, boxes[n + 1 :]
        )
        if one.y < other.y + other.height and other.y < one.y + one.height
    ]


def ends(way):
    """The points where a way begins and ends: the first, and the tip of the head."""
    numbers = [float(number) for number in re.findall(r"-?\d+", way.path)]
    return numbers[:2], numbers[-4:-2]


def test_messages_flow_from_left_to_right():
    diagram, layout = placed(KnownGraph().node("/a", ["/t"]).node("/b", ["/u"], ["/t"]))
    at = {box.name: place.x for box, place in zip(diagram.boxes, layout.boxes, strict=True)}
    assert at["/a"] < at["/t"] < at["/b"] < at["/u"]


@pytest.mark.parametrize("topics", ["all", "none"])
@pytest.mark.parametrize("graph", [robot(), large(300)], ids=["robot", "300 nodes"])
def test_boxes_do_not_overlap_and_lie_within_the_picture(graph, topics):
    diagram, layout = placed(graph, topics)
    assert len(diagram.boxes) == len(layout.boxes)
    assert len(diagram.arrows) == len(layout.ways)
    assert overlaps(layout) == []
    for x, y, width, height, _ in layout.boxes:
        assert 0 < x < x + width < layout.width
        assert 0 < y < y + height < layout.height


def test_the_layout_of_300_nodes_has_the_shape_of_a_screen():
    diagram, layout = placed(large(300))
    assert len(diagram.boxes) == 300 + 602
    assert 0.4 < layout.width / layout.height < 6


def test_the_same_graph_has_the_same_layout():
    assert placed(large(60)) == placed(large(60))


@pytest.mark.parametrize("graph", [robot(), large(60)], ids=["robot", "60 nodes"])
def test_arrows_begin_and_end_at_the_sides_of_their_boxes(graph):
    diagram, layout = placed(graph)
    for arrow, way in zip(diagram.arrows, layout.ways, strict=True):
        for point, index in zip(ends(way), (arrow.source, arrow.target), strict=True):
            x, y, width, height, label = layout.boxes[index]
            assert min(abs(point[0] - x), abs(point[0] - x - width)) <= 1, label
            assert abs(point[1] - y - height / 2) <= 1, label


def test_a_circle_is_drawn_with_one_arrow_back():
    layers = make_layers([0, 0, 0], [(0, 1), (1, 2), (2, 0)])
    assert layers.columns == [[0], [1, 3], [2]]
    assert layers.steps == [1, 1, -2]
    assert layers.joints == [[], [], [3]]


def test_behind_a_circle_messages_flow_on():
    layers = make_layers([0] * 5, [(0, 1), (1, 2), (2, 1), (2, 3), (4, 3)])
    assert layers.columns == [[0], [1], [2, 4], [3]]


def test_a_box_without_input_stands_beside_its_receivers():
    layers = make_layers([0] * 4, [(0, 1), (1, 2), (3, 2)])
    assert layers.columns[1] == [1, 3]


def test_a_box_that_sends_to_itself_gets_a_loop():
    diagram = Diagram([Box("node", "/echo")], [Arrow(0, 0, ("/t",), ())])
    layout = make_layout(diagram)
    assert "C" in layout.ways[0].path


def test_arrows_within_a_column_are_drawn_beside_it():
    pairs = [(0, 1), (0, 2), (1, 2), (2, 1)]
    diagram = Diagram(
        [Box("node", name) for name in ("/a", "/b", "/d")],  # of one width
        [Arrow(*pair, ("/t",), ()) for pair in pairs],
    )
    layout = make_layout(diagram)
    assert len(layout.ways) == 4
    assert layout.boxes[1].x == pytest.approx(layout.boxes[2].x)
    for way in layout.ways[2:]:
        assert way.x > layout.boxes[1].x + layout.boxes[1].width


def test_a_topic_with_hundreds_of_subscriptions_becomes_a_block():
    graph = KnownGraph().node("/clock_source", ["/clock"])
    for number in range(300):
        graph.node(f"/listener_{number}", (), ["/clock"])
    _, layout = placed(graph)
    assert overlaps(layout) == []
    assert 0.4 < layout.width / layout.height < 4


def test_long_names_are_cut_at_their_beginning():
    name = f"/{'namespace/' * 8}node"
    layout = make_layout(Diagram([Box("node", name)], []))
    assert layout.boxes[0].label.startswith("…")
    assert name.endswith(layout.boxes[0].label[1:])


def test_an_empty_graph_has_an_empty_layout():
    layout = make_layout(Diagram([], []))
    assert (layout.boxes, layout.ways) == ([], [])


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
