"""A bag in the view: frames at its time, messages as they are due, jumps."""

from __future__ import annotations

import threading

import pytest
from tests.bags import SECOND, START, write_bag

from turtlewire import msg
from turtlewire.bag import BagWriter
from turtlewire.errors import BagError
from turtlewire_view import BagSource, Viewer
from turtlewire_view.frames import FrameScene
from turtlewire_view.source import Topic

LIMIT_S = 60
TF = "tf2_msgs/msg/TFMessage"


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
    frames = len(whole.buffer.frame_strings())
    whole.close()
    for limit, problem in [
        (frames, ""),
        (frames - 1, f"There are more than {frames - 1} frames; further ones are not shown."),
    ]:
        source = BagSource(path, max_frames=limit)
        assert len(source.buffer.frame_strings()) == limit
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


def test_a_bag_without_frames_is_shown_empty(tmp_path):
    with BagWriter(tmp_path / "texts") as writer:
        writer.add_topic("/chatter", "std_msgs/msg/String")
        writer.write("/chatter", msg.get_message("std_msgs/msg/String")(data="a"), START)
    source = BagSource(tmp_path / "texts")
    assert source.buffer.frame_strings() == []
    source.close()


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
