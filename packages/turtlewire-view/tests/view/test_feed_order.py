"""What a display's page gets, and in which order: events after what they change, no leftovers."""

from __future__ import annotations

import pytest

from turtlewire import msg
from turtlewire.tf.buffer import Buffer
from turtlewire_view.base import Base
from turtlewire_view.display_feed import DisplayFeed
from turtlewire_view.displays.marker import MarkerDisplay
from turtlewire_view.displays.occupancy_grid import OccupancyGridDisplay
from turtlewire_view.displays.point_cloud import PointCloudDisplay

from .packets import decode_packet

Marker = msg.get_message("visualization_msgs/msg/Marker")
MarkerArray = msg.get_message("visualization_msgs/msg/MarkerArray")


class Page:
    """A feed of one topic, and what a page has taken from it."""

    def __init__(self, display, types):
        self.buffer = Buffer()
        self.feed = DisplayFeed("d", display, types, lambda _: None, lambda: None)

    def send(self, message, topic="/t"):
        self.feed.take_message(topic, msg.serialize(message))
        self.feed.work(Base(self.buffer, "map", (0.0, 0.0, 0.0)))

    def take(self):
        return [decode_packet(packet) for packet in self.feed.take_packets()]

    def know(self, frame):
        self.buffer.set_static_transform("map", frame, (1, 2, 3), (0, 0, 0, 1))


@pytest.fixture
def page():
    return Page(MarkerDisplay(), {"/t": "visualization_msgs/msg/Marker"})


def marker(key, action=0, frame="base"):
    message = Marker(ns="n", id=key, type=1, action=action)
    message.header.frame_id = frame
    message.color.a = message.scale.x = message.scale.y = message.scale.z = 1.0
    return message


def test_a_deletion_waits_for_the_marker_that_it_deletes(page):
    page.send(marker(1))
    page.send(marker(2))
    page.send(marker(2, action=2))
    assert [packet["type"] for packet in page.take()] == ["status"]
    page.know("base")
    page.send(marker(3))
    packets = page.take()
    keys = [p["markers"][0]["key"][1] for p in packets if "markers" in p]
    assert keys == [1, 3]  # the second one came and went
    assert packets[0]["pose"][:3] == [1, 2, 3]


def test_a_deletion_removes_the_part_that_it_empties(page):
    page.know("base")
    page.send(marker(1))
    page.send(marker(2))
    page.take()
    page.send(marker(1, action=2))
    removed, delete = page.take()
    assert delete["delete"] == [["n", 1]]
    assert (removed["type"], removed["part"]) == ("removed", "0")


def test_each_update_of_a_map_is_sent():
    types = {"/t": "nav_msgs/msg/OccupancyGrid", "/u": "map_msgs/msg/OccupancyGridUpdate"}
    page = Page(OccupancyGridDisplay(), types)
    page.know("base")
    grid = msg.get_message(types["/t"])(data=[0, 0, 0, 0])
    grid.header.frame_id = "base"
    grid.info.width = grid.info.height = 2
    grid.info.resolution = 1.0
    page.send(grid)
    change = msg.get_message(types["/u"])(width=1, height=1, data=[7])
    for change.x in (0, 1):
        page.send(change, "/u")
    updates = [packet["update"] for packet in page.take() if "update" in packet]
    assert updates == [[0, 0, 1, 1], [1, 0, 1, 1]]


@pytest.mark.parametrize("taken", [True, False])
def test_a_new_map_comes_after_the_updates_of_the_former_one(taken):
    types = {"/t": "nav_msgs/msg/OccupancyGrid", "/u": "map_msgs/msg/OccupancyGridUpdate"}
    page = Page(OccupancyGridDisplay(), types)
    page.know("base")
    grid = msg.get_message(types["/t"])(data=[0])
    grid.header.frame_id = "base"
    grid.info.width = grid.info.height = 1
    grid.info.resolution = 1.0
    page.send(grid)
    if taken:
        page.take()
    change = msg.get_message(types["/u"])(width=1, height=1, data=[7])
    page.feed.take_message("/u", msg.serialize(change))
    page.send(grid)  # both are seen at once
    cells = [p["arrays"]["cells"].tolist() for p in page.take() if p["type"] == "display"]
    assert cells == [[[7]], [[0]]]


def test_a_page_that_takes_nothing_fills_no_memory(page):
    page.know("base")
    page.send(marker(1))
    page.take()
    for _ in range(2000):
        page.send(marker(1))
    for _ in range(1500):
        page.send(marker(2))
        page.send(marker(2, action=2))
    kept = page.feed.take_packets()
    assert len(kept) < 1100
    assert sum(map(len, kept)) < 1_000_000


def test_the_newest_thousand_events_are_kept(page):
    page.know("base")
    for number in range(1001):
        page.send(marker(number))
        page.send(marker(number, action=2))
    deleted = [packet["delete"][0][1] for packet in page.take() if "delete" in packet]
    assert deleted == list(range(1, 1001))


def test_other_options_show_the_last_message_again():
    page = Page(PointCloudDisplay(), {"/t": "sensor_msgs/msg/PointCloud2"})
    page.know("base")
    field = msg.get_message("sensor_msgs/msg/PointField")
    fields = [field(name=name, offset=4 * k, datatype=7, count=1) for k, name in enumerate("xyz")]
    cloud = msg.get_message("sensor_msgs/msg/PointCloud2")(
        height=1, width=1, fields=fields, point_step=12, row_step=12, data=bytes(12)
    )
    cloud.header.frame_id = "base"
    page.send(cloud)
    page.take()
    page.feed.set_options({"color": "flat", "flat_color": [1, 2, 3]})
    page.feed.work(Base(page.buffer, "map", (0.0, 0.0, 0.0)))
    assert page.take()[0]["arrays"]["rgba"].tolist() == [[1, 2, 3, 255]]


@pytest.mark.parametrize(("sent", "dropped"), [(50, 0), (51, 1)])
def test_fifty_contents_wait_for_transforms(page, sent, dropped):
    for number in range(sent):
        page.send(marker(number))
    text = page.take()[-1]["text"]
    assert text.startswith("More than 50 messages wait, the oldest are dropped: ") == bool(dropped)
    assert '"map" passed to lookupTransform argument target_frame does not exist' in text
    page.know("base")
    page.feed.work(Base(page.buffer, "map", (0.0, 0.0, 0.0)))
    keys = [p["markers"][0]["key"][1] for p in page.take() if "markers" in p]
    assert keys == list(range(dropped, sent))


@pytest.mark.parametrize("in_one_message", [True, False])
def test_nothing_is_dropped_whose_transforms_are_known(in_one_message):
    page = Page(MarkerDisplay(), {"/t": "visualization_msgs/msg/MarkerArray"})
    page.know("base")
    markers = [marker(number) for number in range(120)]
    for number, each in enumerate(markers):  # each stamp is a part of its own
        each.header.stamp.sec = number + 1
    for some in [markers] if in_one_message else [[each] for each in markers]:
        page.feed.take_message("/t", msg.serialize(MarkerArray(markers=some)))
    page.feed.work(Base(page.buffer, "map", (0.0, 0.0, 0.0)))
    keys = [p["markers"][0]["key"][1] for p in page.take() if "markers" in p]
    assert keys == list(range(120))


def test_the_status_of_a_wait_ends_with_it(page):
    page.send(marker(1))
    assert page.take()[-1]["level"] == "warn"
    page.know("base")
    page.feed.work(Base(page.buffer, "map", (0.0, 0.0, 0.0)))
    assert page.take()[-1] == {
        "type": "status", "id": "d", "level": "ok", "text": "", "arrays": {},
    }  # fmt: skip


def test_a_fault_of_a_display_is_logged_once(page, monkeypatch, caplog):
    def fail(message):
        raise ArithmeticError("ours")

    monkeypatch.setattr(page.feed.display, "content", fail)
    page.send(marker(1))
    page.send(marker(2))
    assert [packet["level"] for packet in page.take()] == ["error"]
    assert [record.exc_info[0] for record in caplog.records] == [ArithmeticError]


def test_that_no_message_has_come_is_said_until_one_does(page):
    base = Base(page.buffer, "map", (0.0, 0.0, 0.0))
    page.feed.work(base)
    (status,) = page.take()
    assert (status["level"], status["text"]) == ("warn", "No messages received")
    page.know("base")
    page.send(marker(1))
    assert (page.take()[-1]["level"], page.feed.waits) == ("ok", False)
    page.feed.set_options({})
    page.feed.work(base)
    assert page.take() == []
