"""`ros2 bag play`: the messages of a real player, and latched messages at any start."""

import json
import re

import pytest

from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time
from rosbag2_interfaces import srv
from rosbag2_interfaces.msg import ReadSplitEvent
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from tests import places
from tf2_msgs.msg import TFMessage
from turtlewire.bag import BagWriter, open_bag
from turtlewire.wire.qos import Durability, QoS, Reliability

from .conftest import DEEP, LATCHED, end, texts, wait_until_written

GOLDEN = places.GOLDEN / "bag"
SMALL = GOLDEN / "p_small"
SCENES = {scene["name"]: scene for scene in json.loads((GOLDEN / "play.json").read_text())}
#: What listeners of the real player received.
PLAYED = json.loads((GOLDEN / "played.json").read_text())
LOSSY = QoSProfile(depth=1000, reliability=ReliabilityPolicy.BEST_EFFORT)
LEAVES = [f"leaf{i:02d}" for i in range(13)]
START = 1_700_000_000_000_000_000
SECOND = 1_000_000_000

#: What differs on purpose, and why; see docs/compatibility.md.
DEVIATIONS = json.loads((GOLDEN / "deviations.json").read_text())["mended faults"]
#: All that is latched in the small bag, by the names under which it is played.
ALL_LATCHED = {
    "/tf_static": LEAVES,
    "/moved_static": LEAVES,
    "/latched": ["early word", "late word"],
}


def content(message):
    if isinstance(message, String):
        return message.data
    return " ".join(transform.child_frame_id for transform in message.transforms)


def qos_of(topic):
    if topic in ("/tf_static", "/latched", "/moved_static"):
        return LATCHED
    return LOSSY if topic == "/lossy" else DEEP


def listen(peer, topics):
    return {
        topic: peer.listen(topic, qos_of(topic), TFMessage if kind == "tf" else String)
        for topic, kind in topics.items()
    }


def log_of(program):
    lines = [re.sub(r"\[\d+\.\d+\]", "[T]", line) for line in program.text.splitlines()]
    return sorted(line for line in lines if "rosbag2_player" in line)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[] if name == "plain" else pytest.mark.slow)
        for name in SCENES
        if name not in ("services", "loop")
    ],
)
def test_received_messages_equal_those_of_the_real_node(peer, bag_verb, name):
    scene = SCENES[name]
    golden = PLAYED[name]
    got = listen(peer, scene["listen"])
    clock = peer.listen("/clock", LOSSY, Clock)
    player = bag_verb("play", SMALL, *scene["options"])
    assert player.wait() == golden["exit"]
    expected = {
        topic: ALL_LATCHED[topic]
        if f"play {name} {topic}" in DEVIATIONS
        else [row[1] for row in golden["early"] if row[0] == topic]
        for topic in scene["listen"]
    }
    peer.wait_for(lambda: all(len(got[topic]) >= len(rows) for topic, rows in expected.items()))
    assert {topic: list(map(content, rows)) for topic, rows in got.items()} == expected
    assert log_of(player) == sorted(golden["log"])
    assert bool(clock) == bool(golden["clock"]["count"])


def test_each_deviation_is_listed():
    """Listeners get what is latched from before an offset, and late ones as much as early ones."""
    found = set()
    for name, scene in SCENES.items():
        golden = PLAYED[name]
        for topic in ALL_LATCHED.keys() & scene["listen"].keys():
            early, late = (
                [row[1] for row in golden[who] if row[0] == topic] for who in ("early", "late")
            )
            ours = ALL_LATCHED[topic] if name == "offset" else early
            if ours != early:
                found.add(f"play {name} {topic}")
            expected = ours[: len(late)] if name == "loop" else ours  # which ended by itself
            if not scene.get("calls") and late != expected:
                found.add(f"play {name} late {topic}")
    assert found == {each for each in DEVIATIONS if each.startswith("play ")}


def test_services_answer_as_the_real_ones(peer, bag_verb):
    scene = SCENES["services"]
    golden = PLAYED["services"]
    got = listen(peer, scene["listen"])
    bag_verb("play", SMALL, *scene["options"])
    everything = 0
    for call, expected in list(zip(scene["calls"], golden["calls"], strict=True))[:-1]:
        type_ = getattr(srv, call["type"])
        request = type_.Request()
        for field, value in call.get("request", {}).items():
            if isinstance(value, dict):
                for part, number in value.items():
                    setattr(getattr(request, field), part, number)
            else:
                setattr(request, field, value)
        fields = {slot.removeprefix("_"): getattr(request, slot) for slot in request.__slots__}
        answer = peer.call(type_, f"/rosbag2_player/{call['service']}", **fields)
        for field, value in expected["answer"].items():
            assert getattr(answer, field) == value, call
        everything += len(expected["messages"])
        wanted = everything
        peer.wait_for(lambda: sum(map(len, got.values())) >= wanted)  # noqa: B023 - called here
        rows = [[topic, content(m)] for topic, found in got.items() for m in found]
        assert all(row in rows for row in expected["messages"])
        assert len(rows) == everything


def test_one_that_joins_late_gets_all_static_transforms(peer, bag_verb):
    early = peer.listen("/tf_static", LATCHED, TFMessage)
    player = bag_verb("play", SMALL, "-r", "100", "--loop", "-d", "2")
    peer.wait_for(lambda: len(early) >= 13)
    late = peer.listen("/tf_static", LATCHED, TFMessage)
    peer.wait_for(lambda: len(late) >= 13)
    assert sorted(map(content, late[:13])) == LEAVES
    assert end(player) == 0


def test_rounds_of_a_loop_do_not_pile_up_for_one_that_joins_late(peer, bag_verb):
    early = peer.listen("/latched", LATCHED)
    topics = ("--topics", "/latched", "/tf_static")
    player, name = bag_verb("play", SMALL, "-l", "-r", "50", *topics), "/rosbag2_player"
    peer.wait_for(lambda: len(early) >= 8)
    peer.call(srv.Pause, f"{name}/pause")
    peer.call(srv.Burst, f"{name}/burst")  # to the end of the round
    words, leaves = (
        peer.listen(topic, LATCHED, type_)
        for topic, type_ in (("/latched", String), ("/tf_static", TFMessage))
    )
    peer.wait_for(lambda: len(words) >= 2 and len(leaves) >= 13)
    peer.call(srv.Stop, f"{name}/stop")
    assert player.wait() == 0
    assert list(map(content, words)) == ALL_LATCHED["/latched"]
    assert list(map(content, leaves)) == LEAVES


def write_latched(path, **options):
    """A bag of 4 s: `/word` was sent before it began, and again in its third second."""
    with BagWriter(path, **options) as writer:
        latched = QoS(depth=1, durability=Durability.TRANSIENT_LOCAL)
        writer.add_topic("/word", "std_msgs/msg/String", qos=[latched])
        writer.add_topic(
            "/tick", "std_msgs/msg/String", qos=[QoS(reliability=Reliability.RELIABLE)]
        )
        writer.write("/tick", String(data="0"), START)
        writer.write("/word", String(data="first"), START + 1000, START - 60 * SECOND)
        writer.write("/tick", String(data="1"), START + SECOND)
        writer.write("/word", String(data="second"), START + 2 * SECOND)
        writer.write("/tick", String(data="3"), START + 3 * SECOND)
        writer.write("/tick", String(data="4"), START + 4 * SECOND)
    return path


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_paused_playback_has_sent_what_was_latched_before_the_bag(
    peer, bag_verb, tmp_path, storage
):
    words, ticks = peer.listen("/word", LATCHED), peer.listen("/tick")
    player = bag_verb("play", write_latched(tmp_path / "bag", storage=storage), "-p", "-r", "50")
    peer.wait_for(lambda: words)
    assert (list(map(content, words)), ticks) == (["first"], [])
    peer.call(srv.Resume, "/rosbag2_player/resume")
    assert player.wait() == 0
    peer.wait_for(lambda: len(ticks) == 4 and len(words) == 2)
    assert list(map(content, words)) == ["first", "second"]  # not once more at its own time


def test_after_a_seek_listeners_have_what_was_latched_then(peer, bag_verb, tmp_path):
    words, ticks = peer.listen("/word", LATCHED), peer.listen("/tick")
    player = bag_verb("play", write_latched(tmp_path / "bag"), "-p")
    peer.wait_for(lambda: words)
    seek = "/rosbag2_player/seek"
    peer.call(srv.Seek, seek, time=Time(nanoseconds=START + 3 * SECOND).to_msg())
    peer.wait_for(lambda: len(words) == 2)
    peer.call(srv.Seek, seek, time=Time(nanoseconds=START + SECOND).to_msg())
    peer.wait_for(lambda: len(words) == 3)
    assert list(map(content, words)) == ["first", "second", "first"]
    assert peer.call(srv.PlayNext, "/rosbag2_player/play_next").success
    peer.wait_for(lambda: ticks)
    assert content(ticks[0]) == "1"
    assert peer.call(srv.Burst, "/rosbag2_player/burst").actually_burst == 3
    assert not peer.call(srv.PlayNext, "/rosbag2_player/play_next").success
    peer.call(srv.Stop, "/rosbag2_player/stop")
    assert player.wait() == 0


def test_each_round_sends_what_is_latched_before_the_offset(peer, bag_verb, tmp_path):
    words = peer.listen("/word", LATCHED)
    bag = write_latched(tmp_path / "bag")
    player = bag_verb("play", bag, "-l", "-p", "-r", "50", "--start-offset", "2.5")
    peer.wait_for(lambda: len(words) == 2)  # or it might join in the middle of a round
    peer.call(srv.Resume, "/rosbag2_player/resume")
    peer.wait_for(lambda: len(words) >= 8)
    assert list(map(content, words[:8])) == ["first", "second"] * 4
    assert end(player) == 0


def test_keys(peer, bag_verb, tmp_path):
    ticks = peer.listen("/tick")
    player = bag_verb("play", write_latched(tmp_path / "bag"), "-l", "-p", terminal=True)
    player.wait_for("Press CURSOR_DOWN for Decrease Rate 10%")
    player.type("\x1b[C")
    peer.wait_for(lambda: list(map(content, ticks)) == ["0"])
    player.type("\x1b[C")
    peer.wait_for(lambda: list(map(content, ticks)) == ["0", "1"])
    player.type("\x1b[A")
    player.wait_for("Set rate to 1.1")
    player.type("\x1b[B\x1b[B")
    player.wait_for("Set rate to 0.9")
    player.type(" ")
    player.wait_for("Resuming play.")
    player.type(" ")
    player.wait_for("Pausing play.")
    player.type("\x03")
    assert player.wait() == 0


def test_other_nodes_hear_of_the_next_file_and_steer_the_player(peer, bag_verb, tmp_path):
    with BagWriter(tmp_path / "bag", max_file_ns=SECOND) as writer:
        writer.add_topic("/tick", "std_msgs/msg/String")
        for second in (0, 1, 2, 3):
            writer.write("/tick", String(data=str(second)), START + second * SECOND)
    splits = peer.listen("/events/read_split", type_=ReadSplitEvent)
    player, name = bag_verb("play", tmp_path / "bag", "-p"), "/rosbag2_player"
    for _ in range(600):  # until the player knows the listener
        peer.call(srv.Seek, f"{name}/seek", time=Time(nanoseconds=START).to_msg())
        assert peer.call(srv.Burst, f"{name}/burst", num_messages=10).actually_burst == 4
        if splits:
            break
    assert splits[0].closed_file == str(tmp_path / "bag" / "bag_0.mcap")
    assert splits[0].opened_file == str(tmp_path / "bag" / "bag_1.mcap")
    assert splits[0].node_name == name
    peer.call(srv.Seek, f"{name}/seek", time=Time(nanoseconds=START).to_msg())
    assert peer.call(srv.SetRate, f"{name}/set_rate", rate=0.001).success
    peer.call(srv.TogglePaused, f"{name}/toggle_paused")
    assert not peer.call(srv.IsPaused, f"{name}/is_paused").paused
    assert peer.call(srv.GetRate, f"{name}/get_rate").rate == 0.001
    assert peer.call(srv.Burst, f"{name}/burst", num_messages=1).actually_burst == 0
    assert not peer.call(srv.PlayNext, f"{name}/play_next").success
    peer.call(srv.Pause, f"{name}/pause")
    assert peer.call(srv.IsPaused, f"{name}/is_paused").paused
    player.wait_for("Burst can only be used when in the paused state")
    player.wait_for("Called play next, but not in paused state")
    peer.call(srv.Stop, f"{name}/stop")
    assert player.wait() == 0


def test_a_recorded_playback_is_the_bag_again(bag_verb, tmp_path, peer):
    recorder = bag_verb("record", "-o", "again", "--topics", "/a", "/b", "/lossy", "/latched")
    recorder.wait_for("Recording...")
    player = bag_verb("play", SMALL, "-p", "--disable-keyboard-controls")
    recorder.wait_for("All requested topics are subscribed")
    peer.call(srv.Resume, "/rosbag2_player/resume")
    assert player.wait() == 0
    wait_until_written(tmp_path / "again", "/a", len(texts(SMALL, "/a")))
    assert end(recorder) == 0
    for topic in ("/a", "/b", "/lossy", "/latched"):
        assert texts(tmp_path / "again", topic) == texts(SMALL, topic)
    with open_bag(tmp_path / "again") as again, open_bag(SMALL) as first:
        for name, topic in again.topics.items():
            theirs = first.topics[name]
            assert topic.type == theirs.type
            assert topic.qos[0].durability == theirs.qos[0].durability
            assert topic.qos[0].reliability == theirs.qos[0].reliability
