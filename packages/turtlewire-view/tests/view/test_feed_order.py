"""What a display's page gets, and in which order: events after what they change, no leftovers.

Scans beam by beam, decay time, and colours along an axis of the fixed frame.
"""

import math

import numpy as np
import pytest

from turtlewire import msg
from turtlewire.tf.buffer import Buffer
from turtlewire_view.display_feed import DisplayFeed
from turtlewire_view.displays.content import Removal
from turtlewire_view.displays.laser_scan import LaserScanDisplay
from turtlewire_view.displays.marker import MarkerDisplay
from turtlewire_view.displays.occupancy_grid import OccupancyGridDisplay
from turtlewire_view.displays.point_cloud import PointCloudDisplay
from turtlewire_view.frames import Base

from .fake_view import decode_packet

Marker = msg.get_message("visualization_msgs/msg/Marker")
MarkerArray = msg.get_message("visualization_msgs/msg/MarkerArray")


class Page:
    """A feed of one topic, and what a page has taken from it."""

    def __init__(self, display, types):
        self.buffer = Buffer()
        self.feed = DisplayFeed("d", display, types, lambda _: None, lambda: None)

    def send(self, message, topic="/t"):
        self.feed.take_message(topic, msg.serialize(message))
        self.work()

    def work(self):
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


GRID, UPDATE = "nav_msgs/msg/OccupancyGrid", "map_msgs/msg/OccupancyGridUpdate"


def square_map(side):
    grid = msg.get_message(GRID)(data=[0] * side**2)
    grid.header.frame_id = "base"
    grid.info.width = grid.info.height = side
    grid.info.resolution = 1.0
    return grid


def test_each_update_of_a_map_is_sent():
    page = Page(OccupancyGridDisplay(), {"/t": GRID, "/u": UPDATE})
    page.know("base")
    page.send(square_map(2))
    change = msg.get_message(UPDATE)(width=1, height=1, data=[7])
    for change.x in (0, 1):
        page.send(change, "/u")
    updates = [packet["update"] for packet in page.take() if "update" in packet]
    assert updates == [[0, 0, 1, 1], [1, 0, 1, 1]]


@pytest.mark.parametrize("taken", [True, False])
def test_a_new_map_comes_after_the_updates_of_the_former_one(taken):
    page = Page(OccupancyGridDisplay(), {"/t": GRID, "/u": UPDATE})
    page.know("base")
    grid = square_map(1)
    page.send(grid)
    if taken:
        page.take()
    change = msg.get_message(UPDATE)(width=1, height=1, data=[7])
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
    page.work()
    assert page.take()[0]["arrays"]["rgba"].tolist() == [[1, 2, 3, 255]]


@pytest.mark.parametrize(("sent", "dropped"), [(50, 0), (51, 1)])
def test_fifty_contents_wait_for_transforms(page, sent, dropped):
    for number in range(sent):
        page.send(marker(number))
    text = page.take()[-1]["text"]
    assert text.startswith("More than 50 messages wait, the oldest are dropped: ") == bool(dropped)
    assert '"map" passed to lookupTransform argument target_frame does not exist' in text
    page.know("base")
    page.work()
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
    page.work()
    keys = [p["markers"][0]["key"][1] for p in page.take() if "markers" in p]
    assert keys == list(range(120))


def test_the_status_of_a_wait_ends_with_it(page):
    page.send(marker(1))
    assert page.take()[-1]["level"] == "warn"
    page.know("base")
    page.work()
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


SECOND = 10**9
START = 1000 * SECOND


def scan(count=5, increment=0.25, **values):
    message = msg.get_message("sensor_msgs/msg/LaserScan")(
        **{
            "angle_max": (count - 1) * 1e-9,
            "angle_increment": 1e-9,  # all beams point ahead
            "range_max": 10.0,
            "ranges": [1.0] * count,
            "time_increment": increment,
            **values,
        }
    )
    message.header.frame_id = "lidar"
    message.header.stamp.sec = 1000
    return message


def turning_robot(until_s=2.0):
    """``lidar`` turns by a quarter each second and moves along x by one metre each second."""
    buffer = Buffer()
    for k in range(round(until_s * 20) + 1):
        seconds = k / 20
        half = seconds * math.pi / 4
        rotation = (0.0, 0.0, math.sin(half), math.cos(half))
        stamp = START + round(seconds * SECOND)
        buffer.set_transform("map", "lidar", stamp, (seconds, 0.0, 0.0), rotation)
    buffer.set_static_transform("lidar", "lens", (0, 0, 0), (0, 0, 0, 1))
    return buffer


def places(base, content):
    """Where the points of a content are drawn."""
    x, y, z, *turn = base.pose(content)
    points = base.arrays(content)["points"].astype(float)
    pose = Buffer()
    pose.set_static_transform("a", "b", (x, y, z), turn)
    matrix = pose.lookup_transform("a", "b", None).as_matrix()
    return points @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.parametrize("fixed", ["map", "lidar"])
def test_each_beam_is_drawn_from_where_the_scanner_was(fixed):
    content, status = LaserScanDisplay().content(scan())
    assert status.level == "ok"
    seen = places(Base(turning_robot(), fixed, (0.0, 0.0, 0.0)), content)
    times = np.arange(5) * 0.25
    turned = np.stack([np.cos(times * math.pi / 2), np.sin(times * math.pi / 2)], axis=1)
    expected = {"map": turned + np.stack([times, 0 * times], axis=1), "lidar": [[1, 0]] * 5}[fixed]
    np.testing.assert_allclose(seen[:, :2], expected, atol=2e-3)


def test_a_scan_without_times_is_drawn_from_its_stamp():
    for message in (scan(increment=0.0), scan(increment=1e9), scan(increment=-1.0)):
        content = LaserScanDisplay().content(message)[0]
        assert content.placed is None
    status = LaserScanDisplay().content(scan(increment=1e9))[1]
    assert status.text.startswith("time_increment 1e+09 s is not used: 5 beams would take 5e+09 s")


def feed_of(display, type_name):
    return DisplayFeed("d", display, {"/t": type_name}, lambda _: None, lambda: None)


def test_a_scan_waits_for_the_transforms_of_its_last_beam():
    feed = feed_of(LaserScanDisplay(), "sensor_msgs/msg/LaserScan")
    feed.take_message("/t", msg.serialize(scan()))
    feed.work(Base(turning_robot(until_s=0.5), "map", (0.0, 0.0, 0.0)))
    (status,) = map(decode_packet, feed.take_packets())
    assert "extrapolation into the future" in status["text"]
    assert feed.waits
    feed.work(Base(turning_robot(), "map", (0.0, 0.0, 0.0)))
    kinds = [decode_packet(packet)["type"] for packet in feed.take_packets()]
    assert kinds == ["display", "status"]


def test_in_another_fixed_frame_the_beams_are_sent_anew():
    feed = feed_of(LaserScanDisplay(), "sensor_msgs/msg/LaserScan")
    feed.take_message("/t", msg.serialize(scan()))
    buffer = turning_robot()
    points = []
    for fixed in ("map", "lidar"):
        feed.work(Base(buffer, fixed, (0.0, 0.0, 0.0)))
        (shown,) = (
            packet
            for packet in map(decode_packet, feed.take_packets())
            if packet["type"] == "display"
        )
        points.append(shown["arrays"]["points"])
    assert np.abs(points[0] - points[1]).max() > 0.5


def cloud(*heights):
    rows = np.array([(0, 0, z) for z in heights], "f4")
    Field = msg.get_message("sensor_msgs/msg/PointField")  # noqa: N806
    message = msg.get_message("sensor_msgs/msg/PointCloud2")(
        height=1, width=len(rows), point_step=12, row_step=12 * len(rows), data=rows.tobytes(),
        fields=[Field(name=n, offset=4 * k, datatype=7, count=1) for k, n in enumerate("xyz")],
    )  # fmt: skip
    message.header.frame_id = "lidar"
    return message


def test_the_axis_is_one_of_the_fixed_frame():
    buffer = Buffer()  # the sensor's z is the map's x
    half = math.sqrt(0.5)
    buffer.set_static_transform("map", "lidar", (3, 0, 0), (0, half, 0, half))
    base = Base(buffer, "map", (0.0, 0.0, 0.0))
    options = {"color": "axis", "axis": "x", "autocompute_axis": False, "axis_min": 3}
    low, high = [255, 0, 255, 255], [255, 0, 0, 255]  # of RViz's rainbow, upside down
    content = PointCloudDisplay({**options, "axis_max": 4}).content(cloud(0, 1))[0]
    seen = base.arrays(content)["rgba"].tolist()
    assert seen[0] != seen[1]
    own = PointCloudDisplay({**options, "axis_max": 4, "axis_in_fixed_frame": False})
    content = own.content(cloud(0, 1))[0]
    assert content.placed is None
    same = base.arrays(content)["rgba"].tolist()
    assert same[0] == same[1] != seen[1]
    assert {tuple(seen[0]), tuple(seen[1])} == {tuple(low), tuple(high)}


def test_points_stay_for_their_decay_time():
    now = [0]
    display = PointCloudDisplay({"decay_time": 2}, clock=lambda: now[0])

    def after(seconds):
        now[0] = round(seconds * SECOND)
        return display.content(cloud(0))[:-1]

    (first,) = after(0)
    (second,) = after(1.5)
    assert (first.part, second.part) == ("0", "1")
    assert first.header["decay"] == 2
    third, gone = after(2.5)
    assert (third.part, gone) == ("2", Removal("0"))
    assert display.start() == [Removal("1"), Removal("2")]
    assert PointCloudDisplay().content(cloud(0))[0].part == ""


def test_points_that_stay_share_the_budget():
    now = [0]
    display = PointCloudDisplay({"decay_time": 100}, clock=lambda: now[0])
    display.budget = 100
    held = {}
    for _ in range(300):
        now[0] += SECOND // 10
        for output in display.content(cloud(*range(50)))[:-1]:
            if isinstance(output, Removal):
                del held[output.part]
            else:
                held[output.part] = len(output.arrays["points"])
        assert sum(held.values()) <= 150
    assert len(held) == 100


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"angle_increment": 0.0}, "angle_increment is 0: all 5 beams are drawn at 0 rad"),
        ({"angle_max": math.nan}, "angle_max is nan: the beams are drawn by angle_min and"),
        ({"angle_increment": -0.5, "angle_max": 2.0}, "-0.5 leads from angle_min 0 away from"),
        ({"angle_increment": 0.5, "angle_max": 1.0}, "and angle_increment say 3"),
        ({"range_max": 0.0}, "no range lies between range_min 0 and range_max 0"),
        ({"range_min": math.nan}, "no range lies between range_min nan and"),
        ({"range_min": 3.0, "range_max": 2.0}, "lies between range_min 3 and range_max 2"),
    ],
)
def test_a_scan_with_impossible_limits_says_so(values, said):
    *_, status = LaserScanDisplay().content(scan(**values))
    assert status.level == "warn"
    assert said in status.text


@pytest.mark.parametrize("values", [{"angle_increment": math.nan}, {"angle_min": math.inf}])
def test_a_scan_without_angles_is_not_drawn(values):
    (status,) = LaserScanDisplay().content(scan(**values))
    assert status.level == "error"
    assert "must be finite" in status.text


def test_a_scan_that_turns_clockwise_is_no_mistake():
    content, status = LaserScanDisplay().content(scan(angle_increment=-0.5, angle_max=-2.0))
    assert status.level == "ok"
    assert content.arrays["points"][-1].tolist() == pytest.approx(
        [math.cos(2.0), -math.sin(2.0), 0.0]
    )
