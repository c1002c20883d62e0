"""Markers that users move, and menus on them."""

import pytest

from geometry_msgs.msg import Point, Pose
from interactive_markers import InteractiveMarkerServer, MenuHandler
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerUpdate,
    MenuEntry,
)
from visualization_msgs.srv import GetInteractiveMarkers

POSE_UPDATE = InteractiveMarkerFeedback.POSE_UPDATE
MENU_SELECT = InteractiveMarkerFeedback.MENU_SELECT
BUTTON_CLICK = InteractiveMarkerFeedback.BUTTON_CLICK


class View:
    """Acts as a 3D view: requests the markers, follows the updates and sends feedback."""

    def __init__(self, context):
        self.node = Node("view", context=context)
        self.updates = []
        self.node.create_subscription(
            InteractiveMarkerUpdate, "/robot/tool/update", self.updates.append, 100
        )
        self.publisher = self.node.create_publisher(
            InteractiveMarkerFeedback, "/robot/tool/feedback", 100
        )
        self.client = self.node.create_client(
            GetInteractiveMarkers, "/robot/tool/get_interactive_markers"
        )

    def send(self, **fields):
        self.publisher.publish(feedback(**fields))


class Executor(SingleThreadedExecutor):
    def until(self, is_done):
        while not is_done():
            self.spin_once(timeout_sec=60)


@pytest.fixture
def context(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with Context() as context:
        yield context


@pytest.fixture
def server(context):
    node = Node("arm", namespace="/robot", context=context)
    yield InteractiveMarkerServer(node, "tool")
    node.destroy_node()


@pytest.fixture
def view(context):
    view = View(context)
    yield view
    view.node.destroy_node()


@pytest.fixture
def executor(context, server, view):
    executor = Executor(context=context)
    executor.add_node(server.node)
    executor.add_node(view.node)
    yield executor
    executor.shutdown()


def marker(name="knob", x=0.0, **fields):
    fields.setdefault("header", Header(frame_id="base"))
    return InteractiveMarker(name=name, pose=pose(x), scale=0.5, **fields)


def pose(x):
    return Pose(position=Point(x=x))


def feedback(name="knob", client="rviz", event=POSE_UPDATE, **fields):
    return InteractiveMarkerFeedback(marker_name=name, client_id=client, event_type=event, **fields)


def x_of(server, name="knob"):
    return server.get(name).pose.position.x


def test_a_view_gets_the_changes_when_they_are_applied(server, view, executor):
    server.insert(marker("a", 1.0))
    server.insert(marker("b", 2.0))
    assert server.setPose("b", pose(3.0))
    server.applyChanges()
    server.applyChanges()  # nothing changed
    assert server.setPose("a", pose(4.0), Header(frame_id="map"))
    assert server.erase("b")
    server.applyChanges()
    executor.until(lambda: len(view.updates) == 2)
    first, second = view.updates
    assert (first.seq_num, second.seq_num) == (1, 2)
    assert {(each.type, each.server_id) for each in view.updates} == {(1, "tool")}
    assert first.markers == [marker("a", 1.0), marker("b", 3.0)]
    assert (first.poses, first.erases) == ([], [])
    assert (second.markers, second.erases) == ([], ["b"])
    (moved,) = second.poses
    assert (moved.name, moved.header.frame_id, moved.pose) == ("a", "map", pose(4.0))


def test_a_late_view_asks_for_the_markers(server, view, executor):
    def ask():
        future = view.client.call_async(GetInteractiveMarkers.Request())
        executor.until(future.done)
        return future.result()

    assert view.client.wait_for_service(60)
    server.insert(marker())
    assert ask() == GetInteractiveMarkers.Response()
    server.applyChanges()
    server.setPose("knob", pose(7.0))
    assert ask() == GetInteractiveMarkers.Response(sequence_number=1, markers=[marker()])


def test_a_marker_is_read_as_it_will_be(server):
    server.insert(marker(x=1.0))
    assert server.get("knob") == marker(x=1.0)
    server.applyChanges()
    server.setPose("knob", pose(2.0))
    assert server.get("knob") == marker(x=2.0)
    server.erase("knob")
    assert server.get("knob") is None


def test_the_server_keeps_copies(server):
    given = marker(x=1.0)
    server.insert(given)
    given.pose.position.x = 5.0
    place = pose(2.0)
    server.get("knob").pose.position.x = 6.0
    assert x_of(server) == 1.0
    server.setPose("knob", place)
    place.position.x = 7.0
    assert x_of(server) == 2.0


def test_an_unknown_marker_is_not_changed(server):
    assert server.get("knob") is None
    assert server.setPose("knob", pose(1.0)) is False
    assert server.setCallback("knob", print) is False
    assert server.erase("knob") is False
    server.insert(marker())
    assert server.erase("knob")
    assert server.setPose("knob", pose(1.0)) is False


def test_clearing_removes_all(server, view, executor):
    server.insert(marker("a"))
    server.applyChanges()
    server.insert(marker("b"))
    server.clear()
    assert server.get("a") is server.get("b") is None
    server.applyChanges()
    server.insert(marker("c"))
    server.applyChanges()
    server.shutdown()
    executor.until(lambda: len(view.updates) == 4)
    assert "a" in view.updates[1].erases
    assert view.updates[1].markers == []
    assert view.updates[3].erases == ["c"]


def test_a_user_moves_a_marker(server, view, executor):
    heard = []

    def on_feedback(message):
        heard.append(message)
        server.applyChanges()  # as the tutorials do: the server is not locked here

    server.insert(marker(), feedback_callback=on_feedback)
    server.applyChanges()
    view.send(pose=pose(3.0))
    executor.until(lambda: len(view.updates) == 2)
    assert [each.pose for each in heard] == [pose(3.0)]
    assert [each.pose for each in view.updates[1].poses] == [pose(3.0)]
    assert server.get("knob") == marker(x=3.0)


@pytest.mark.parametrize(("stamp", "frame"), [(0, "base"), (1, "map")])
def test_a_marker_without_stamp_stays_in_its_frame(server, stamp, frame):
    stamped = Header(frame_id="base")
    stamped.stamp.sec = stamp
    server.insert(marker(header=stamped))
    server.applyChanges()
    server.processFeedback(feedback(pose=pose(3.0), header=Header(frame_id="map")))
    assert server.get("knob").header.frame_id == frame
    assert x_of(server) == 3.0


def test_a_callback_for_one_type_goes_before_the_default(server):
    heard = []
    server.insert(marker(), feedback_callback=lambda _: heard.append("any"))
    server.applyChanges()
    assert server.setCallback("knob", lambda _: heard.append("click"), BUTTON_CLICK)
    server.processFeedback(feedback(event=BUTTON_CLICK))
    server.processFeedback(feedback(event=MENU_SELECT))
    assert server.setCallback("knob", None, BUTTON_CLICK)
    assert server.setCallback("knob", None, BUTTON_CLICK)
    server.processFeedback(feedback(event=BUTTON_CLICK))
    assert heard == ["click", "any", "any"]
    server.setCallback("knob", None)
    server.processFeedback(feedback(event=BUTTON_CLICK))
    assert len(heard) == 3


def test_a_replaced_marker_keeps_its_callbacks_and_an_erased_one_does_not(server):
    heard = []
    server.insert(marker(), feedback_callback=heard.append)
    server.applyChanges()
    server.erase("knob")
    server.insert(marker(x=1.0))
    server.applyChanges()
    server.processFeedback(feedback())
    assert len(heard) == 1
    server.erase("knob")
    server.applyChanges()
    server.processFeedback(feedback())
    server.insert(marker())
    server.applyChanges()
    server.processFeedback(feedback())
    assert len(heard) == 1


def test_feedback_does_not_bring_an_erased_marker_back(server):
    server.insert(marker())
    server.applyChanges()
    server.erase("knob")
    server.processFeedback(feedback(pose=pose(2.0)))
    assert server.get("knob") is None


def test_two_views_do_not_pull_at_one_marker(server, monkeypatch):
    seconds = 100.0
    clock = type("Clock", (), {"now": lambda _: Time(nanoseconds=round(seconds * 1e9))})()
    monkeypatch.setattr(server.node, "get_clock", lambda: clock)
    for name in ("knob", "other"):
        server.insert(marker(name))
    server.applyChanges()
    server.processFeedback(feedback(pose=pose(1.0), client="a"))
    seconds = 100.999
    server.processFeedback(feedback(pose=pose(2.0), client="b"))
    server.processFeedback(feedback("other", pose=pose(2.0), client="b"))
    assert (x_of(server), x_of(server, "other")) == (1.0, 2.0)
    server.processFeedback(feedback(pose=pose(3.0), client="a"))
    seconds = 101.999
    server.processFeedback(feedback(pose=pose(4.0), client="b"))
    assert x_of(server) == 4.0


def test_the_profiles_are_the_ones_given(context):
    node = Node("arm", context=context)
    default = InteractiveMarkerServer(node, "a")
    assert (default.update_pub.qos_profile.depth, default.feedback_sub.qos_profile.depth) == (
        100,
        1,
    )
    other = InteractiveMarkerServer(node, "b", 7, feedback_sub_qos=3)
    assert (other.update_pub.qos_profile.depth, other.feedback_sub.qos_profile.depth) == (7, 3)
    profile = default.update_pub.qos_profile
    given = InteractiveMarkerServer(node, "c", 7, update_pub_qos=profile)
    assert given.update_pub.qos_profile.depth == 100
    node.destroy_node()


@pytest.fixture
def menu():
    return MenuHandler()


def entries(server, name="knob"):
    return [(each.id, each.parent_id, each.title) for each in server.get(name).menu_entries]


def test_a_user_selects_an_entry(server, view, executor, menu):
    heard = []
    modes = menu.insert("Modes")
    slow = menu.insert("Slow", parent=modes, callback=heard.append)
    server.insert(marker())
    assert menu.apply(server, "knob")
    server.applyChanges()
    view.send(event=MENU_SELECT, menu_entry_id=slow)
    executor.until(lambda: heard)
    assert [each.menu_entry_id for each in heard] == [slow]
    for without_callback in (modes, 99):
        server.processFeedback(feedback(event=MENU_SELECT, menu_entry_id=without_callback))
    server.processFeedback(feedback(event=BUTTON_CLICK, menu_entry_id=slow))
    assert len(heard) == 1


def test_entries_come_before_their_submenus(server, menu):
    modes = menu.insert("Modes")
    stop = menu.insert("Stop", command_type=MenuEntry.ROSRUN, command="turtlesim x")
    slow = menu.insert("Slow", parent=modes)
    assert (modes, stop, slow) == (1, 2, 3)
    assert menu.insert("Lost", parent=9) is None
    server.insert(marker())
    menu.apply(server, "knob")
    assert entries(server) == [(1, 0, "Modes"), (3, 1, "Slow"), (2, 0, "Stop")]
    last = server.get("knob").menu_entries[-1]
    assert (last.command_type, last.command) == (MenuEntry.ROSRUN, "turtlesim x")


def test_entries_have_check_boxes_and_can_be_hidden(server, menu):
    modes = menu.insert("Modes")
    slow = menu.insert("Slow", parent=modes)
    server.insert(marker())
    menu.apply(server, "knob")
    assert menu.getCheckState(slow) == MenuHandler.NO_CHECKBOX
    for state, title in ((MenuHandler.CHECKED, "[x] Slow"), (MenuHandler.UNCHECKED, "[ ] Slow")):
        assert menu.setCheckState(slow, state)
        assert menu.getCheckState(slow) == state
        assert menu.reApply(server)
        assert entries(server) == [(1, 0, "Modes"), (2, 1, title)]
    assert menu.getTitle(slow) == "Slow"
    assert menu.setVisible(modes, False)
    menu.reApply(server)
    assert entries(server) == []
    assert menu.setVisible(modes, True)
    menu.reApply(server)
    assert len(entries(server)) == 2


def test_an_unknown_handle_is_not_changed(menu):
    assert menu.setVisible(1, True) is False
    assert menu.setCheckState(1, MenuHandler.CHECKED) is False
    assert menu.getCheckState(1) is None
    assert menu.getTitle(1) is None


def test_a_menu_forgets_a_marker_that_is_gone(server, menu):
    menu.insert("Stop")
    server.insert(marker("a"))
    server.insert(marker("b"))
    assert menu.apply(server, "c") is False
    assert menu.apply(server, "a")
    assert menu.apply(server, "b")
    server.erase("a")
    server.insert(marker("b"))
    assert menu.reApply(server) is False
    assert entries(server, "b") == [(1, 0, "Stop")]
    assert menu.reApply(server) is True
