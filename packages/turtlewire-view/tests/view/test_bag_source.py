"""A bag in the view: frames at its time, messages as they are due, jumps."""

import contextlib
import random
import shutil
import threading

import pytest
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore
from tests.bags import SECOND, START, write_bag
from tests.rosbags_messages import random_message

from turtlewire import msg
from turtlewire.bag import BagWriter
from turtlewire.errors import BagError
from turtlewire_view import BagSource, Viewer
from turtlewire_view.bag_source import StampsOfLog
from turtlewire_view.frames import FrameScene
from turtlewire_view.source import Topic

LIMIT_S = 60
TF = "tf2_msgs/msg/TFMessage"
TRANSFORM = "geometry_msgs/msg/TransformStamped"


class Heard:
    """Texts of /chatter."""

    def __init__(self):
        self._news = threading.Condition()
        self.texts = []

    def __call__(self, cdr):
        with self._news:
            self.texts.append(msg.deserialize(msg.get_message("std_msgs/msg/String"), cdr).data)
            self._news.notify_all()

    def wait_for(self, texts):
        with self._news:
            assert self._news.wait_for(lambda: self.texts == texts, LIMIT_S), self.texts


@pytest.fixture
def source(tmp_path):
    source = BagSource(write_bag(tmp_path / "made"))
    yield source
    source.close()


def test_it_knows_its_topics_and_its_time(source):
    assert (source.kind, source.name) == ("bag", "made")
    assert Topic("/chatter", "std_msgs/msg/String", 1) in source.topics()
    source.pause()
    state = source.state()
    assert (state.oldest, state.newest) == (START / SECOND, pytest.approx(START / SECOND + 0.991))
    assert not state.playing
    assert not state.live


def test_it_shows_so_many_frames_and_says_that_there_are_more(tmp_path):
    assert BagSource.__init__.__kwdefaults__["max_frames"] == 5_000
    path = write_bag(tmp_path / "made")
    whole = BagSource(path)
    frames = len(whole.buffer.frames())
    whole.close()
    for limit, problem in [
        (frames, ""),
        (frames - 1, f"There are more than {frames - 1} frames; further ones are not shown."),
    ]:
        source = BagSource(path, max_frames=limit)
        assert len(source.buffer.frames()) == limit
        assert source.problem.partition(" (turtlewire view")[0] == problem
        source.close()


def test_messages_come_when_they_are_due(source):
    source.pause()
    source.seek(START)
    heard = Heard()
    end = source.subscribe("/chatter", "std_msgs/msg/String", heard)
    source.play()
    heard.wait_for([f"number {i}" for i in range(9, 100, 10)])
    end()


def test_a_jump_shows_what_was_published_last(source):
    source.pause()
    heard = Heard()
    source.seek(START + SECOND // 2)
    end = source.subscribe("/chatter", "std_msgs/msg/String", heard)
    heard.wait_for(["number 49"])
    source.seek(START + SECOND // 4)
    heard.wait_for(["number 49", "number 19"])
    source.seek(0)  # before the bag
    source.seek(START + 10 * SECOND)  # behind it
    heard.wait_for(["number 49", "number 19", "number 99"])
    end()


def test_a_message_at_the_time_of_a_jump_comes_once(source):
    source.pause()
    heard = Heard()
    received_ns = START + 49 * 10_000_000 + 1_000_001
    source.seek(received_ns - 1)
    end = source.subscribe("/chatter", "std_msgs/msg/String", heard)
    heard.wait_for(["number 39"])
    source.seek(received_ns)
    heard.wait_for(["number 39", "number 49"])
    source.play()
    heard.wait_for([f"number {i}" for i in range(39, 100, 10)])
    end()


@pytest.mark.parametrize(
    ("log_ns", "shown_ns"), [(500, 0), (999, 0), (1000, 5), (1999, 5), (2000, 6), (9000, 6)]
)
def test_the_stamp_of_a_log_time_is_the_last_one_received_until_then(tmp_path, log_ns, shown_ns):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", TF)
        for received_ns, stamp_ns in ((1000, 5), (1500, None), (2000, 6)):
            message = msg.get_message(TF)()
            if stamp_ns is not None:
                message.transforms.append(msg.get_message(TRANSFORM)())
                message.transforms[0].header.stamp.nanosec = stamp_ns
            writer.write("/tf", message, received_ns)
    assert StampsOfLog(tmp_path / "made").at(log_ns) == shown_ns


def test_it_stops_at_its_end_and_plays_again(source):
    ended = threading.Event()

    def look():
        if not source.state().playing:
            ended.set()

    source.on_change(look)
    source.set_speed(100)
    assert source.state().now == source.state().oldest  # nobody looks yet
    source.new_timeline()
    assert ended.wait(LIMIT_S)
    assert source.state().now == source.state().newest
    source.play()
    assert source.state().now < source.state().newest


def test_files_that_vanish_are_a_problem_until_they_are_back(tmp_path):
    path = write_bag(tmp_path / "made")
    with contextlib.closing(BagSource(path)) as source:
        found = threading.Event()
        source.on_change(lambda: source.problem and found.set())
        source.pause()
        away = shutil.move(path, tmp_path / "away")
        heard = Heard()
        source.subscribe("/chatter", "std_msgs/msg/String", heard)
        assert found.wait(LIMIT_S)
        assert source.problem.startswith(f"The bag cannot be read: there is no bag at {path}")
        shutil.move(away, path)
        source.seek(START + SECOND // 4)
        heard.wait_for(["number 19"])
        assert source.problem == ""


def test_it_takes_no_messages(source):
    with pytest.raises(BagError, match="nothing was published on /goal_pose"):
        source.publish("/goal_pose", "geometry_msgs/msg/PoseStamped", b"")


def test_a_bag_whose_stamps_are_of_a_simulation(tmp_path):
    source = BagSource(write_tf(tmp_path / "simulated", [(10, 0), (11, 4), (12, 8)]))
    scene = FrameScene()
    source.pause()
    places = []
    for second in (0, 1, 2, 1):
        source.seek(START + second * SECOND)
        found = scene.look(source.buffer, "", source.stamp_ns())
        places.append(float(found.poses[found.structure.names.index("robot"), 0]))
    assert places == [0, 4, 8, 4]
    source.close()


def write_tf(path, samples):
    """A bag with a transform a second; `samples` are seconds of the simulation, and x."""
    tf, one = (msg.get_message(name) for name in (TF, "geometry_msgs/msg/TransformStamped"))
    with BagWriter(path) as writer:
        writer.add_topic("/tf", TF)
        writer.write("/tf", tf(), START, START)  # none at all
        for number, (stamp_s, x) in enumerate(samples):
            link = one(child_frame_id="robot")
            link.header.frame_id, link.header.stamp.sec = "world", stamp_s
            link.transform.translation.x = float(x)
            writer.write("/tf", tf(transforms=[link]), START + number * SECOND)
    return path


@pytest.mark.parametrize(
    ("stamps_ns", "shown_ns"),
    [((1000, 1000), 2000), ((999, 999), 999), ((2000, 2000), 2000), ((2001, 2001), 2001)],
)
def test_stamps_within_the_time_of_the_bag_are_its_own(tmp_path, stamps_ns, shown_ns):
    with BagWriter(tmp_path / "made") as writer:
        writer.add_topic("/tf", TF)
        for received_ns, stamp_ns in zip((1000, 2000), stamps_ns, strict=True):
            one = msg.get_message(TRANSFORM)(child_frame_id="base")
            one.header.frame_id, one.header.stamp.nanosec = "map", stamp_ns
            one.transform.rotation.w = 1.0
            writer.write("/tf", msg.get_message(TF)(transforms=[one]), received_ns)
    with contextlib.closing(BagSource(tmp_path / "made")) as source:
        source.pause()
        source.seek(2000)
        assert source.stamp_ns() == shown_ns


def test_a_bag_without_frames_is_shown_empty(tmp_path):
    with BagWriter(tmp_path / "texts") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
        writer.write("/chatter", msg.get_message("std_msgs/msg/String")(data="a"), START)
    source = BagSource(tmp_path / "texts")
    assert source.buffer.frames() == []
    source.close()


def test_an_old_bag_without_frames_shows_its_messages_in_their_own(tmp_path, open_view_page):
    foxy = get_typestore(Stores.ROS2_FOXY)
    names = {"marker": "visualization_msgs/msg/Marker", "pose": "geometry_msgs/msg/PoseStamped"}
    with Writer(tmp_path / "lost", version=8) as writer:
        for number, (kind, name) in enumerate(names.items()):
            message = random_message(foxy, name, random.Random(4))
            message.header.frame_id = f"camera_{kind}"
            at, turn = message.pose.position, message.pose.orientation
            at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w = 2.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0
            if kind == "marker":
                message.type, message.action = 1, 0
                message.lifetime.sec = message.lifetime.nanosec = 0
                message.scale.x = message.scale.y = message.scale.z = message.color.a = 1.0
            connection = writer.add_connection(f"/{kind}", name, typestore=foxy)
            writer.write(connection, START + number, foxy.serialize_cdr(message, name))
    viewer = Viewer(BagSource(tmp_path / "lost"), port=0)
    try:
        page = open_view_page(viewer)
        for kind in names:
            page.send("add", id=kind, kind=kind, topic=f"/{kind}", options={})
            packet = page.wait_for("display", lambda p, kind=kind: p["id"] == kind)
            assert packet["pose"][1:3] == [0.0, 0.0]
            assert packet["pose"][3:] == [0.0, 0.0, 0.0, 1.0]
        page.close()
    finally:
        viewer.close()


def test_a_page_scrubs_through_a_bag(source, open_view_page):
    viewer = Viewer(source, port=0)
    try:
        page = open_view_page(viewer)
        page.send("pause")
        page.send("seek", stamp=START / SECOND + 0.5)
        page.wait_for("frames", lambda p: page.places(p).get("base_link") is not None)
        page.send("speed", factor=2.0)
        page.send("play")
        page.wait_for("time", lambda p: p["playing"] and p["speed"] == 2.0)
        page.close()
    finally:
        viewer.close()
