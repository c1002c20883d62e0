"""The view over a real wire: what a page is told, may ask for, and leaves behind."""

import contextlib
import gc
import json
import threading

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays_of
from websockets.sync.client import connect

from turtlewire import msg
from turtlewire.web.packets import encode_packet
from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view import LiveSource, Viewer, session
from turtlewire_view.display_feed import DisplayFeed

from .fake_view import decode_packet

NOW_S = 1_800_000_000
#: Kinds of displays with a type that is not the first one of the kind.
TWO_TYPES = [
    ("image", "sensor_msgs/msg/Image"),
    ("marker", "visualization_msgs/msg/MarkerArray"),
    ("pose", "geometry_msgs/msg/PoseWithCovarianceStamped"),
]


def test_frames_come_with_their_names_and_move(robot, page):
    assert page.wait_for("hello")["source"]["kind"] == "live"
    robot.send("map", "base", (1, 0, 0), NOW_S)
    page.wait_for_places({"map": (0, 0, 0), "base": (1, 0, 0)})
    robot.send("map", "base", (2, 0, 0), NOW_S + 1)
    page.wait_for_places({"map": (0, 0, 0), "base": (2, 0, 0)})
    robot.send("base", "laser", (0, 0, 1), 0, static=True)
    page.wait_for_places({"map": (0, 0, 0), "base": (2, 0, 0), "laser": (2, 0, 1)})
    rows = {
        row["name"]: row for row in page.wait_for("tree", lambda p: len(p["rows"]) == 2)["rows"]
    }
    assert (rows["base"]["publisher"], rows["laser"]["static"]) == ("/robot", True)


def test_nothing_is_sent_again_while_nothing_changes(robot, page):
    robot.send("map", "base", (1, 0, 0), NOW_S)
    page.wait_for_places({"map": (0, 0, 0), "base": (1, 0, 0)})
    seen = page.count()
    page.wait_for("tree", after=seen)
    seen = page.count()
    page.wait_for("tree", after=seen)
    assert "frames" not in page.kinds()[seen:]


def test_the_fixed_frame_is_the_pages_own(robot, viewer, page, open_view_page):
    robot.send("map", "base", (1, 0, 0), NOW_S)
    page.wait_for_places({"map": (0, 0, 0), "base": (1, 0, 0)})
    other = open_view_page(viewer)
    other.send("fixed", frame="base")
    other.wait_for_places({"map": (-1, 0, 0), "base": (0, 0, 0)})
    assert other.wait_for("names", lambda p: p["chosen"] == "base")["fixed"] == "base"
    robot.send("map", "base", (3, 0, 0), NOW_S + 1)
    page.wait_for_places({"map": (0, 0, 0), "base": (3, 0, 0)})
    other.wait_for_places({"map": (-3, 0, 0), "base": (0, 0, 0)})


def test_one_frame_as_another_sees_it(robot, page):
    robot.send("map", "base", (1, 0, 0), NOW_S)
    robot.send("base", "laser", (0, 0, 1), NOW_S)
    page.send("relation", target="map", source="laser")
    answer = page.wait_for("relation", lambda p: p.get("path") == ["laser", "base", "map"])
    assert answer["translation"] == [1, 0, 1]
    page.send("relation", target="map", source="lasre")
    answer = page.wait_for("relation", lambda p: p["source"] == "lasre" and "error" in p)
    assert "laser" in answer["hint"]


def test_a_paused_page_goes_back_in_time(robot, page):
    for second in range(4):
        robot.send("map", "base", (second, 0, 0), NOW_S + second)
    page.wait_for_places({"map": (0, 0, 0), "base": (3, 0, 0)})
    page.send("seek", stamp=NOW_S + 1.5)
    page.wait_for_places({"map": (0, 0, 0), "base": (1.5, 0, 0)})
    assert not page.wait_for("time", lambda p: not p["live"])["playing"]
    robot.send("map", "base", (9, 0, 0), NOW_S + 4)
    seen = page.count()
    page.wait_for("tree", after=seen)
    page.send("seek", stamp=NOW_S + 100)
    page.wait_for_places({"map": (0, 0, 0), "base": (3, 0, 0)}, after=seen)
    page.send("play")
    page.wait_for_places({"map": (0, 0, 0), "base": (9, 0, 0)}, after=seen)


def test_a_pause_changes_nothing_of_the_picture(robot, page):
    robot.send("map", "slow", (1, 0, 0), NOW_S)
    for late in (0.0, 0.5):
        robot.send("map", "fast", (2, 0, 0), NOW_S + late)
    everything = {"map": (0, 0, 0), "slow": (1, 0, 0), "fast": (2, 0, 0)}
    page.wait_for_places(everything)
    page.send("relation", target="slow", source="fast")
    page.send("pause")
    page.wait_for("time", lambda p: not p["live"])
    seen = page.count()
    page.send("fixed", frame="slow")
    page.wait_for_places({"map": (-1, 0, 0), "slow": (0, 0, 0), "fast": (1, 0, 0)}, after=seen)
    found = page.wait_for("relation", after=seen)
    assert found["translation"] == [1, 0, 0]


def test_the_time_that_can_be_shown_does_not_begin_with_a_link_that_ended(robot, page):
    robot.send("map", "ended", (1, 0, 0), NOW_S - 500)
    for second in range(3):
        robot.send("map", "base", (second, 0, 0), NOW_S + second)
    page.wait_for("time", lambda p: p["newest"] == NOW_S + 2 and p["oldest"] == NOW_S + 2 - 60)


@pytest.mark.parametrize(
    ("message", "answer"),
    [
        ("{", "not JSON"),
        ("[" * 60_000, "not "),  # JSON that ends early, where the stack holds that many
        ("[]", "type is one of fixed, relation"),
        (b"\x00\xff", "not JSON"),
        ('{"type": "fly"}', "type is one of fixed, relation"),
        ('{"type": "fixed", "frame": 3}', "frame must be a string"),
        (json.dumps({"type": "fixed", "frame": "x" * 2000}), "at most 1024 characters"),
        ('{"type": "seek", "stamp": -0.1}', "stamp must be a number from 0"),
        ('{"type": "seek", "stamp": NaN}', "stamp must be a number from 0"),
        ('{"type": "seek", "stamp": 1e400}', "stamp must be a number from 0"),
        ('{"type": "speed", "factor": -1}', "factor must be a number from"),
        (
            '{"type": "add", "id": "1", "kind": "nothing", "topic": "/x", "options": {}}',
            "No display 'nothing'",
        ),
        ('{"type": "options", "id": "1", "options": {}}', "no display '1'"),
        ('{"type": "budget", "points": true}', "points must be a number"),
        (
            json.dumps({"type": "publish", "tool": "point", "position": [10**400, 0, 0]}),
            "position must be a list of three finite numbers",
        ),
    ],
)
def test_wrong_commands_are_answered_and_the_page_lives(page, message, answer):
    page.send_raw(message)
    page.wait_for("error", lambda p: answer in p["text"])
    page.send("fixed", frame="elsewhere")
    page.wait_for("names", lambda p: p["chosen"] == "elsewhere")


def test_pages_that_leave_are_forgotten(viewer, open_view_page):
    for _ in range(3):
        page = open_view_page(viewer)
        page.wait_for("hello")
        page.close()
    viewer.close()  # returns
    with pytest.raises(ConnectionRefusedError):
        open_view_page(viewer)


def test_a_display_takes_the_type_that_its_topic_comes_with(robot, page):
    """A page that connects again asks for its displays before their topics are discovered."""
    for number, (kind, type_name) in enumerate(TWO_TYPES):
        page.send("add", id=kind, kind=kind, topic=f"/later_{number}", options={})
        page.wait_for("status", lambda packet, kind=kind: packet["id"] == kind)
        publisher = robot.publisher(f"/later_{number}", type_name, QoS())
        assert robot.wait_for(publisher.is_heard)
        publisher.publish(msg.serialize(msg.get_message(type_name)()))
        page.wait_for("status", lambda p, kind=kind: p["id"] == kind and "No mes" not in p["text"])


@pytest.mark.parametrize(
    "qos", [QoS(durability=Durability.TRANSIENT_LOCAL), QoS(reliability=Reliability.BEST_EFFORT)]
)
def test_a_display_subscribes_as_its_publishers_offer(robot, page, qos):
    """Whatever a file says: it hears the best-effort ones, and what latched ones have said."""
    publisher = robot.publisher("/pose", TWO_TYPES[2][1], qos)
    cdr = msg.serialize(msg.get_message(TWO_TYPES[2][1])())
    publisher.publish(cdr)
    page.wait_for("topics", lambda packet: any(t["name"] == "/pose" for t in packet["topics"]))
    page.send("add", id="a", kind="pose", topic="/pose", options={})
    assert robot.wait_for(publisher.is_heard)
    if qos.durability != Durability.TRANSIENT_LOCAL:
        publisher.publish(cdr)
    page.wait_for("status", lambda packet: "header.frame_id is empty" in packet["text"])


def test_a_source_without_anything_closes_at_once():
    Viewer(LiveSource(), port=0).close()


def test_a_page_says_that_there_are_more_frames_than_it_shows(robot, open_view_page):
    assert LiveSource.__init__.__kwdefaults__["max_frames"] == 5_000
    viewer = Viewer(LiveSource(max_frames=3), port=0)
    with contextlib.closing(viewer):
        page = open_view_page(viewer)
        robot.send("map", "base", (1, 0, 0), NOW_S)
        robot.send("map", "tip", (0, 1, 0), NOW_S)
        page.wait_for_places({"map": (0, 0, 0), "base": (1, 0, 0), "tip": (0, 1, 0)})
        assert page.wait_for("status")["text"] == ""
        robot.send("map", "invented", (0, 0, 1), NOW_S)
        page.wait_for(
            "status",
            lambda packet: (
                packet["text"] == "There are more than 3 frames; further ones are not "
                "shown. (turtlewire view --max-frames N)"
            ),
        )
        robot.send("map", "base", (2, 0, 0), NOW_S + 1)
        page.wait_for_places({"map": (0, 0, 0), "base": (2, 0, 0), "tip": (0, 1, 0)})


KINDS = st.sampled_from([np.float32, np.float64, np.uint8, np.uint16, np.int32])
ARRAYS = st.dictionaries(
    st.text(max_size=5),
    KINDS.flatmap(lambda kind: arrays_of.arrays(kind, arrays_of.array_shapes(min_side=0))),
    max_size=3,
)


@given(st.dictionaries(st.text(st.characters(codec="utf-8")), st.text()), ARRAYS)
def test_a_packet_comes_back(header, arrays):
    header = {name: value for name, value in header.items() if name != "arrays"}
    decoded = decode_packet(encode_packet(header, arrays))
    found = decoded.pop("arrays")
    assert decoded == header
    assert list(found) == list(arrays)
    for name, array in arrays.items():
        np.testing.assert_array_equal(found[name], array)


def test_slices_are_sent_in_order():
    columns = np.arange(12, dtype=np.float32).reshape(4, 3)[:, ::2]
    found = decode_packet(encode_packet({}, {"columns": columns}))["arrays"]["columns"]
    np.testing.assert_array_equal(found, columns)


def test_numbers_that_json_cannot_hold_are_refused():
    with pytest.raises(ValueError, match="not JSON compliant"):
        encode_packet({"speed": float("nan")})


ROUNDS = 20
PATH = "nav_msgs/msg/Path"
IMAGE, OFFERED = "sensor_msgs/msg/Image", 60


def living(kind):
    gc.collect()
    return sum(issubclass(type(each), kind) for each in gc.get_objects())


def path_bytes():
    message = msg.get_message(PATH)()
    message.header.frame_id = "map"
    pose = msg.get_message("geometry_msgs/msg/PoseStamped")()
    message.poses = [pose] * 50
    return msg.serialize(message)


def test_pages_displays_and_topics_that_come_and_go(robot, viewer, open_view_page):
    robot.send("map", "base", (1, 0, 0), 1_800_000_000)
    watcher = open_view_page(viewer)
    watcher.wait_for("frames")
    sessions, threads = living(session.ViewSession), threading.active_count()
    cdr = path_bytes()
    for number in range(ROUNDS):
        topic = f"/path_{number}"
        publisher = robot.publisher(topic, PATH, QoS())
        page = open_view_page(viewer)
        page.wait_for("topics", lambda p, name=topic: name in (t["name"] for t in p["topics"]))
        page.send("add", id="a", kind="path", topic=topic, options={})
        assert robot.wait_for(publisher.is_heard)
        publisher.publish(cdr)
        page.wait_for("display", lambda p: p["id"] == "a")
        if number % 2:
            page.send("remove", id="a")
        page.close()
        assert robot.wait_for(lambda end=publisher: not end.subscription_count())
        publisher.close()
    # The server may still be about to forget the last page.
    left = threading.Event()
    for _ in range(600):
        if living(DisplayFeed) == 0 and living(session.ViewSession) == sessions:
            break
        left.wait(0.1)
    assert living(DisplayFeed) == 0
    assert living(session.ViewSession) == sessions
    assert threading.active_count() <= threads
    watcher.wait_for("topics", lambda p: not any("path_" in t["name"] for t in p["topics"]))


def test_a_page_that_stops_reading_holds_up_nobody(robot, viewer, open_view_page):
    """It is offered far more than any buffer holds, and sees the newest when it reads again."""
    image = msg.get_message(IMAGE)(width=800, height=600, encoding="rgb8", step=2400)
    image.header.frame_id, image.data = "map", bytes(800 * 600 * 3)
    cdr = msg.serialize(image)
    publisher = robot.publisher("/image", IMAGE, QoS())
    watcher = open_view_page(viewer)
    watcher.wait_for("topics", lambda p: "/image" in (t["name"] for t in p["topics"]))
    add = {"type": "add", "id": "a", "kind": "image", "topic": "/image", "options": {}}
    address = f"{viewer.url.replace('http', 'ws', 1)}live"
    with connect(address, max_size=None, max_queue=1) as slow:
        slow.send(json.dumps(add))
        assert robot.wait_for(publisher.is_heard)
        for number in range(OFFERED):
            robot.send("map", "base", (number, 0, 0), 1_800_000_000 + number)
            publisher.publish(cdr)
            watcher.wait_for_places({"map": (0, 0, 0), "base": (number, 0, 0)})
        pictures, place = 0, None
        while place != OFFERED - 1:
            packet = decode_packet(slow.recv(timeout=60))
            pictures += packet["type"] == "display"
            if packet["type"] == "frames" and len(packet["arrays"]["poses"]) == 2:
                place = packet["arrays"]["poses"][1][0]
    assert 0 < pictures < OFFERED / 2


def test_topics_that_tools_have_published_on_do_not_add_up(robot, viewer):
    point = "geometry_msgs/msg/PointStamped"
    cdr = msg.serialize(msg.get_message(point)())
    for number in range(3 * ROUNDS):
        viewer.source.publish(f"/point_{number % (2 * ROUNDS)}", point, cdr)
    last = 3 * ROUNDS % (2 * ROUNDS) - 1
    graph = viewer.source._context.graph
    topics = [end.topic for end in graph.endpoints() if end.topic.startswith("/point_")]
    assert len(topics) <= ROUNDS
    assert f"/point_{last}" in topics
