"""`turtlewire frames`: the tree of a buffer as text and JSON, and the command in pipes and terminals."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path

import pytest

import turtlewire
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from turtlewire import msg, wire
from turtlewire.cli.frames import forget_former_time, take_picture
from turtlewire.cli.main import main
from turtlewire.tf.listener import QOS, STATIC_QOS
from turtlewire.wire.base import TypeId

COMMAND = (Path(sys.executable).parent / "turtlewire", "frames")
TF = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))
SECOND = 1_000_000_000
NOW_NS = 1_800_000_000 * SECOND
RED, BLUE = "\033[31m", "\033[34m"


def put(buffer, parent, child, *ages_s, now_ns=NOW_NS, static=False, sender="/someone"):
    for age_s in ages_s:
        why = buffer.set_transform(
            parent,
            child,
            now_ns - round(age_s * 1e9),
            (1.0, 0.0, 0.0),
            (0.0, 0.0, 0.0, 1.0),
            static,
            sender,
        )
        assert not why


@pytest.fixture
def buffer():
    filled = turtlewire.Buffer()
    put(filled, "world", "robot", 0.3, 0.2, 0.1)
    put(filled, "robot", "lost", 5.0, sender="/gone")
    put(filled, "lost", "below", 0.0)
    put(filled, "robot", "camera", 0.0, static=True, sender="/fixed")
    return filled


def test_a_tree_as_text(buffer):
    assert take_picture(buffer, NOW_NS).as_text() == [
        "world",
        "└─ robot          0.100 s    10.0 Hz  /someone",
        "   ├─ lost        5.000 s             /gone  (stale)",
        "   │  └─ below    0.000 s             /someone",
        "   └─ camera       static             /fixed",
    ]


def test_stale_is_red_and_static_is_blue(buffer):
    lines = take_picture(buffer, NOW_NS).as_text(coloured=True)
    assert [line[:5] for line in lines if line.startswith("\033")] == [RED, BLUE]
    assert all(line.endswith("\033[0m") for line in lines if line.startswith("\033"))
    assert [len(line) for line in take_picture(buffer, NOW_NS).as_text(columns=10)] == [
        5,
        10,
        10,
        10,
        10,
    ]


def test_a_slow_link_is_stale_after_three_of_its_periods():
    buffer = turtlewire.Buffer()
    put(buffer, "world", "slow", 8.0, 4.0)
    assert not take_picture(buffer, NOW_NS).rows[1].stale
    assert take_picture(buffer, NOW_NS + 9 * SECOND).rows[1].stale


def test_simulated_time_is_counted_from_the_newest_stamp():
    buffer = turtlewire.Buffer()
    put(buffer, "world", "robot", 0.0, now_ns=20 * SECOND)
    put(buffer, "world", "lost", 3.0, now_ns=20 * SECOND)
    picture = take_picture(buffer, NOW_NS)
    assert picture.now_ns == 20 * SECOND
    assert [(row.frame, row.age_s, row.stale) for row in picture.rows[1:]] == [
        ("robot", 0.0, False),
        ("lost", 3.0, True),
    ]


def test_a_world_that_begins_anew_is_shown(buffer):
    static = {row.frame for row in take_picture(buffer, NOW_NS).rows if row.static}
    before = forget_former_time(buffer, {})
    late = buffer.set_transform("world", "robot", NOW_NS - 100 * SECOND, (0, 0, 0), (0, 0, 0, 1))
    assert late.startswith("TF_OLD_DATA")
    put(buffer, "world", "robot", 0.0)
    before = forget_former_time(buffer, before)
    assert buffer.lookup_transform("world", "robot").stamp_ns == NOW_NS  # it still goes on
    buffer.set_transform("world", "robot", SECOND, (0, 0, 0), (0, 0, 0, 1))
    before = forget_former_time(buffer, before)
    put(buffer, "world", "robot", 0.0, now_ns=2 * SECOND)
    forget_former_time(buffer, before)
    rows = {row.frame: row for row in take_picture(buffer, NOW_NS).rows}
    assert (rows["robot"].age_s, rows["robot"].stale) == (0.0, False)
    assert {frame for frame, row in rows.items() if row.static} == static


def test_names_do_not_steer_the_terminal():
    buffer = turtlewire.Buffer()
    put(buffer, "a\nb", "turtle\x1b[2J", 0.0, sender="/x\x07")
    text = "\n".join(take_picture(buffer, NOW_NS).as_text())
    assert text.count("\n") == 1
    assert "turtle\\x1b[2J" in text
    assert text.replace("\n", "").isprintable()


def test_loops_are_named_and_deep_trees_are_drawn():
    buffer = turtlewire.Buffer()
    put(buffer, "a", "b", 0.0)
    put(buffer, "b", "a", 0.0)
    assert take_picture(buffer, NOW_NS).as_text()[-1] == "Loop: b -> a -> b"
    for i in range(3000):
        put(buffer, f"deep{i}", f"deep{i + 1}", 0.0)
    assert len(take_picture(buffer, NOW_NS).rows) == 3003


def test_a_tree_as_json(buffer):
    data = json.loads(take_picture(buffer, NOW_NS).as_json())
    assert data["now_ns"] == NOW_NS
    assert data["loops"] == []
    assert [frame["frame"] for frame in data["frames"]] == [
        "world",
        "robot",
        "lost",
        "below",
        "camera",
    ]
    robot = {
        "frame": "robot",
        "parent": "world",
        "static": False,
        "age": 0.1,
        "rate": 10.0,
        "publishers": ["/someone"],
        "stale": False,
    }
    assert data["frames"][1] == robot
    assert (data["frames"][0]["parent"], data["frames"][4]["age"]) == (None, None)


def test_nothing_was_heard(capsys, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    assert main(["frames", "--once", "--period", "0.05"]) == 1
    assert (
        capsys.readouterr().out
        == f"No transforms on /tf and /tf_static yet (ROS_DOMAIN_ID={os.environ['ROS_DOMAIN_ID']}).\n"
    )


def test_what_cannot_be_a_period(capsys):
    for words in ("0", "nan", "-1", "soon"):
        with pytest.raises(SystemExit) as end:
            main(["frames", f"--period={words}"])
        assert end.value.code == 2
        assert "--period" in capsys.readouterr().err


@pytest.fixture
def talker():
    """Publishes a moving frame and a static one, until the test ends."""
    context = wire.open_context()
    node = context.create_node("talker")
    static = node.create_publisher("/tf_static", TF, STATIC_QOS)
    moving = node.create_publisher("/tf", TF, QOS)
    ended = threading.Event()

    def message(child, now_ns):
        transform = TransformStamped(child_frame_id=child)
        transform.header.frame_id = "world"
        transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(now_ns, SECOND)
        return msg.serialize(TFMessage(transforms=[transform]))

    def talk():
        static.publish(message("map", 0))
        while not ended.wait(0.02):
            moving.publish(message("robot", time.time_ns()))

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    ended.set()
    thread.join()
    context.close()


@pytest.mark.usefixtures("talker")
def test_a_pipe_gets_plain_trees_until_ctrl_c(run):
    program = run(*COMMAND, "--period", "0.3")
    program.wait_for(r"^[├└]─ robot +-?\d+\.\d{3} s +\d+\.\d Hz  /talker$", count=2)
    program.wait_for(r"^[├└]─ map +static +/talker$")
    program.signal_group(signal.SIGINT)
    assert program.wait() == 130
    assert "\033" not in program.text
    assert "Traceback" not in program.text


@pytest.mark.usefixtures("talker")
def test_json_and_once(run):
    program = run(*COMMAND, "--json", "--once", "--period", "2")
    assert program.wait() == 0
    (line,) = program.text.splitlines()
    frames = {frame["frame"]: frame for frame in json.loads(line)["frames"]}
    assert frames.keys() == {"world", "robot", "map"}
    assert frames["robot"]["publishers"] == ["/talker"]


@pytest.mark.usefixtures("talker")
@pytest.mark.parametrize("no_color", ["", "1"])
def test_a_terminal_is_redrawn_until_ctrl_c(run, no_color):
    program = run(
        *COMMAND,
        "--period",
        "0.3",
        terminal=True,
        environment={"NO_COLOR": no_color, "PYTHONUTF8": "1"},
    )
    program.wait_for(r"─ map +static", count=2)
    program.type("\x03")
    assert program.wait() == 130
    assert program.text.count("\033[H\033[2J") >= 2
    assert (BLUE in program.text) == (not no_color)
    assert "Traceback" not in program.text


@pytest.mark.usefixtures("talker")
def test_a_reader_that_leaves_is_no_error(run):
    program = run("bash", "-c", f"set -o pipefail; '{COMMAND[0]}' frames --period 0.2 | head -n 1")
    assert program.wait() == 0, program.text
    assert "Traceback" not in program.text
    assert "BrokenPipe" not in program.text
