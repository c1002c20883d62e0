"""The view over a real wire: what a page is told, and what it may ask for."""

import contextlib
import json

import pytest

from turtlewire import msg
from turtlewire.wire.qos import Durability, QoS, Reliability
from turtlewire_view import LiveSource, Viewer

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
