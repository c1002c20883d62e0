"""A server of interactive markers and the 3D view in a real browser, over the real middleware."""

import contextlib
import threading

import pytest
from tests.pages import PROJECT, wait_until

import rclpy
from interactive_markers import InteractiveMarkerServer, MenuHandler
from rclpy.executors import SingleThreadedExecutor
from turtlewire_view import LiveSource, Viewer
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerControl,
    InteractiveMarkerFeedback,
)

LIMIT_S = 60
UP = InteractiveMarkerFeedback.MOUSE_UP
#: Look down on the square of 8 m around the origin, and show the markers of /arm.
SHOW = """async () => {
    const { displays, stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    stage.cameras.choose("top");
    stage.cameras.isTouched = true;
    stage.cameras.look(new Vector3(0, 0, 0), 4);
    await displays.add({ kind: "interactive_markers", topic: "/arm/update" });
}"""
#: Whether a marker is there, at this x.
IS_AT = """async ([name, x]) => {
    const { displays, stage } = await import("./js/main.js");
    const { Vector3 } = await import("three");
    stage.view.draw(performance.now());
    let found = null;
    displays.list[0]?.parts?.object.traverse((each) => {
        if (each.userData.control?.name === name) found = each.getWorldPosition(new Vector3());
    });
    return found !== null && Math.abs(found.x - x) < 0.05;
}"""


class Arm:
    """A node with a marker that users move along x, and a menu on it."""

    def __init__(self, name="knob", x=0.0):
        self.news = threading.Condition()
        self.heard = []
        self.chosen = []
        self.node = rclpy.create_node("arm")
        self.server = InteractiveMarkerServer(self.node, "arm")
        marker = InteractiveMarker(name=name, scale=1.0)
        marker.header.frame_id = "map"
        marker.pose.position.x = x
        axis = InteractiveMarkerControl(
            name=name, interaction_mode=InteractiveMarkerControl.MOVE_AXIS
        )
        marker.controls.append(axis)
        self.server.insert(marker, feedback_callback=self._take)
        self.menu = MenuHandler()
        self.menu.insert("Open", callback=self._choose)
        self.menu.apply(self.server, name)
        self.server.applyChanges()
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.thread = threading.Thread(target=self.executor.spin)
        self.thread.start()

    def _take(self, feedback):
        self.server.applyChanges()
        with self.news:
            self.heard.append(feedback)
            self.news.notify_all()

    def _choose(self, feedback):
        with self.news:
            self.chosen.append(feedback.menu_entry_id)
            self.news.notify_all()

    def wait_for(self, is_true):
        with self.news:
            assert self.news.wait_for(is_true, LIMIT_S), self.heard

    def close(self):
        self.executor.shutdown()
        self.thread.join()
        self.node.destroy_node()


@pytest.fixture
def network():
    with rclpy.init():
        yield


@pytest.fixture
def page(network, browser_3d):
    source = LiveSource()
    source.buffer.set_static_transform("map", "base", (1, 0, 0))
    with Viewer(source, "map", port=0) as viewer:
        context = browser_3d.new_context(viewport={"width": 900, "height": 700})
        page = context.new_page()
        errors = []
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(viewer.url)
        page.wait_for_selector("#connection[data-state=live]")
        yield page
        context.close()
        assert errors == []


def test_a_user_moves_a_marker_and_the_server_hears_it(page):
    with contextlib.closing(Arm()) as arm:
        page.evaluate(SHOW)
        assert wait_until(page, IS_AT, ["knob", 0]), page.inner_text("#display-list")
        page.mouse.move(*page.evaluate(PROJECT, [0.7, 0, 0]))
        page.mouse.down()
        page.mouse.move(*page.evaluate(PROJECT, [1.7, 0, 0]), steps=5)
        page.mouse.up()
        arm.wait_for(lambda: any(each.event_type == UP for each in arm.heard))
        arm.wait_for(lambda: arm.server.get("knob").pose.position.x > 0.95)
        assert wait_until(page, IS_AT, ["knob", 1])
        page.mouse.click(*page.evaluate(PROJECT, [1.7, 0, 0]), button="right")
        page.click(".marker-menu button")
        arm.wait_for(lambda: arm.chosen == [1])


@pytest.mark.slow
def test_a_server_that_comes_again_is_asked_again(page):
    page.evaluate(SHOW)
    page.wait_for_function(
        "() => document.querySelector('#display-list').textContent.includes('Only changed markers')"
    )
    with contextlib.closing(Arm("first", 1.0)):
        assert wait_until(page, IS_AT, ["first", 1])
    with contextlib.closing(Arm("second", 2.0)):
        assert wait_until(page, IS_AT, ["second", 2])
        assert wait_until(page, f"async (at) => !(await ({IS_AT})(at))", ["first", 1])


@pytest.mark.slow
def test_a_server_that_starts_before_another_ends_is_asked(page):
    page.evaluate(SHOW)
    with contextlib.closing(Arm("first", 1.0)) as first:
        assert wait_until(page, IS_AT, ["first", 1])
        with contextlib.closing(Arm("second", 2.0)):
            first.close()
            assert wait_until(page, IS_AT, ["second", 2])
