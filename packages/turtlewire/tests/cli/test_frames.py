"""`turtlewire frames`.

The tree of a buffer as text and JSON, and the command in pipes and terminals.
"""

import contextlib
import json
import os
import re
import signal
import threading
import time

import pytest
from tests.places import ROOT, TURTLEWIRE

import turtlewire
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage
from turtlewire import msg, wire
from turtlewire.cli.frame_picture import take_picture
from turtlewire.cli.frames import Window
from turtlewire.cli.main import main
from turtlewire.doctor import network
from turtlewire.tf.listener import QOS, STATIC_QOS
from turtlewire.wire.base import TypeId

COMMAND = (TURTLEWIRE, "frames")
TF = TypeId("tf2_msgs/msg/TFMessage", msg.type_hash("tf2_msgs/msg/TFMessage"))
SECOND = 1_000_000_000
NOW_NS = 1_800_000_000 * SECOND
RED, BLUE = "\033[31m", "\033[34m"


def put(buffer, parent, child, *ages_s, now_ns=NOW_NS, static=False, sender="/someone"):
    for age_s in ages_s:
        if static:
            buffer.set_static_transform(parent, child, (1.0, 0.0, 0.0), sender=sender)
        else:
            stamp_ns = now_ns - round(age_s * 1e9)
            buffer.set_transform(parent, child, stamp_ns, (1.0, 0.0, 0.0), sender=sender)


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
        "frame                 age       rate  publisher",
        "world",
        "└─ robot          0.100 s    10.0 Hz  /someone",
        "   ├─ camera       static             /fixed",
        "   └─ lost        5.000 s             /gone  (stale)",
        "      └─ below    0.000 s             /someone",
    ]


def test_a_frame_whose_publisher_left_is_marked_and_red(buffer):
    picture = take_picture(buffer, NOW_NS, departed=["lost", "below"])
    *_, lost, below = picture.as_text()
    assert lost.endswith("/gone  (publisher left)")
    assert below.endswith("0.000 s             /someone  (publisher left)")
    assert picture.as_text(coloured=True)[-1].startswith(RED)
    assert [row["departed"] for row in json.loads(picture.as_json())["frames"]][-2:] == [True, True]


def test_stale_is_red_and_static_is_blue(buffer):
    lines = take_picture(buffer, NOW_NS).as_text(coloured=True)
    assert [line[:5] for line in lines if line.startswith("\033[3")] == [BLUE, RED]
    assert all(line.endswith("\033[0m") for line in lines if line.startswith("\033"))
    cut = take_picture(buffer, NOW_NS).as_text(columns=10)
    assert [len(line) for line in cut] == [10, 5, 10, 10, 10, 10]


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
        ("lost", 3.0, True),
        ("robot", 0.0, False),
    ]


def test_names_do_not_steer_the_terminal():
    buffer = turtlewire.Buffer()
    put(buffer, "a\nb", "turtle\x1b[2J", 0.0, sender="/x\x07")
    text = "\n".join(take_picture(buffer, NOW_NS).as_text())
    assert text.count("\n") == 2
    assert "turtle\\x1b[2J" in text
    assert text.replace("\n", "").isprintable()


def test_frames_keep_their_place_whichever_was_heard_first():
    names = ["camera", "turtle1", "turtle2", "turtle10", "turtle10b"]
    for order in (names, names[::-1]):
        buffer = turtlewire.Buffer()
        for name in order:
            put(buffer, f"root_{name}", name, 0.0)
            put(buffer, "world", f"root_{name}", 0.0)
        frames = [row.frame for row in take_picture(buffer, NOW_NS).rows]
        assert [frame for frame in frames if frame in names] == names


def test_a_subtree(buffer):
    picture = take_picture(buffer, NOW_NS, "lost")
    assert picture.as_text()[1:] == [
        "lost        5.000 s             /gone  (stale)",
        "└─ below    0.000 s             /someone",
    ]
    put(buffer, "a", "b", 0.0)
    put(buffer, "b", "a", 0.0)
    assert take_picture(buffer, NOW_NS, "lost").loops == []
    (frames, loops) = take_picture(buffer, NOW_NS, "b")[1:3]
    assert ([row.frame for row in frames], loops) == (["b", "a"], [["b", "a"]])


def test_a_frame_that_is_not_there_suggests_others(buffer):
    picture = take_picture(buffer, NOW_NS, "robt")
    assert picture.as_text() == ["No frame 'robt' yet. Did you mean: robot"]
    assert json.loads(picture.as_json())["frames"] == []
    assert take_picture(buffer, NOW_NS, "\x1b[2J").as_text() == [r"No frame '\x1b[2J' yet."]


@pytest.fixture
def window(monkeypatch, capsys):
    """A window of 5 frames on a tree of 12; the numbers of those shown after a key."""
    monkeypatch.setenv("LINES", "8")
    monkeypatch.setenv("COLUMNS", "80")
    buffer = turtlewire.Buffer()
    for number in range(1, 12):
        put(buffer, "0", str(number), 0.0)
    shown = Window()
    shown.show(take_picture(buffer, NOW_NS))

    def press(key):
        capsys.readouterr()
        shown.press(key)
        header, *lines, status = capsys.readouterr().out.splitlines()
        assert header.startswith("\033[H\033[2Jframe ")
        numbers = [int(line.lstrip("├└─ ").split()[0]) for line in lines]
        assert status == f"{numbers[0] + 1}-{numbers[-1] + 1} of 12: arrow keys scroll, q quits"
        return numbers

    return press


def test_keys_scroll_a_tree_that_is_too_long(window):
    assert window("up") == [0, 1, 2, 3, 4]
    assert window("down") == [1, 2, 3, 4, 5]
    assert window("page down") == [5, 6, 7, 8, 9]
    assert window("page down") == [7, 8, 9, 10, 11]
    assert window("down") == [7, 8, 9, 10, 11]
    assert window("page up") == [3, 4, 5, 6, 7]
    assert window("end") == [7, 8, 9, 10, 11]
    assert window("home") == [0, 1, 2, 3, 4]


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
    page = (ROOT / "docs" / "reference" / "ros2_json.md").read_text(encoding="utf-8")
    (row,) = re.findall(r"^\| `turtlewire frames` \| (.*) \|$", page, re.MULTILINE)
    assert {*data, *data["frames"][0]} == set(re.findall(r"`(\w+)`", row))
    assert data["loops"] == []
    assert [frame["frame"] for frame in data["frames"]] == [
        "world",
        "robot",
        "camera",
        "lost",
        "below",
    ]
    robot = {
        "frame": "robot",
        "parent": "world",
        "static": False,
        "age": 0.1,
        "rate": 10.0,
        "publishers": ["/someone"],
        "stale": False,
        "departed": False,
    }
    assert data["frames"][1] == robot
    assert (data["frames"][0]["parent"], data["frames"][2]["age"]) == (None, None)


def test_nothing_was_heard(capsys, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    monkeypatch.setattr(network, "udp_ports", set)
    assert main(["frames", "--once", "--period", "0.05"]) == 1
    assert (
        capsys.readouterr().out == "No transforms on /tf and /tf_static yet "
        f"(ROS_DOMAIN_ID={os.environ['ROS_DOMAIN_ID']}).\n"
    )


def test_frames_names_other_domains(capsys, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    monkeypatch.setenv("ROS_DOMAIN_ID", "4")
    monkeypatch.setattr(network, "udp_ports", lambda: {7410 + 250 * 4, 7410 + 250 * 3})
    assert main(["frames", "--once", "--period", "0.05"]) == 1
    assert capsys.readouterr().out.splitlines()[1:] == [
        (
            "This computer has nodes on domain 3: to reach them, end this program and type: "
            "export ROS_DOMAIN_ID=3"
        )
    ]
    assert main(["frames", "--once", "--period", "0.05", "--json"]) == 1
    assert "domain" not in capsys.readouterr().out


def test_a_robot_in_a_namespace(capsys, monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with contextlib.closing(wire.open_context()) as context:
        node = context.create_node("robot")
        node.create_publisher("/robot1/tf", TF, QOS)
        static = node.create_publisher("/robot1/tf_static", TF, STATIC_QOS)
        transform = TransformStamped(child_frame_id="camera")
        transform.header.frame_id = "base"
        static.publish(msg.serialize(TFMessage(transforms=[transform])))
        assert main(["frames", "--once", "--period", "0.05"]) == 1
        options = "--topic /robot1/tf --static-topic /robot1/tf_static"
        assert capsys.readouterr().out.splitlines()[1:] == [
            f"Published are /robot1/tf, /robot1/tf_static: turtlewire frames {options}"
        ]
        assert main(["frames", "--once", "--period", "0.05", *options.split()]) == 0
    assert "└─ camera" in capsys.readouterr().out


def test_the_missing_part_is_wrapped_in_a_narrow_terminal():
    picture = take_picture(turtlewire.Buffer(), NOW_NS)
    lines = picture.as_text(columns=30)
    assert all(len(line) <= 30 for line in lines)
    assert " ".join(lines) == picture.missing


def test_invalid_periods(capsys):
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
def test_a_reader_that_leaves_ends_it_as_it_ends_other_tools(run):
    program = run("bash", "-c", f"set -o pipefail; '{COMMAND[0]}' frames --period 0.2 | head -n 1")
    assert program.wait() == 141, program.text
    assert "Traceback" not in program.text
    assert "BrokenPipe" not in program.text


@pytest.mark.usefixtures("talker")
def test_forced_ascii_is_borne(run):
    program = run(*COMMAND, "--once", "--period", "2", environment={"PYTHONIOENCODING": "ascii"})
    assert program.wait() == 0, program.text
    lines = program.text.splitlines()
    assert lines[1] == "world"
    assert lines[2].startswith("|- map ")
    assert lines[3].startswith("`- robot ")


@pytest.mark.usefixtures("talker")
def test_q_ends_it_and_the_terminal_is_as_before(run):
    """The echo of typed words is off meanwhile, on again afterwards."""
    program = run(
        "bash", "-c", f"'{COMMAND[0]}' frames --period 0.3; echo status $?; stty -a", terminal=True
    )
    program.wait_for(r"─ map +static", count=2)
    program.type("q")
    program.wait_for(r"^status 0$")
    program.wait()
    assert re.search(r"(?<!-)\bicanon\b", program.text)
    assert re.search(r"(?<!-)\becho\b", program.text)


@pytest.mark.usefixtures("talker")
def test_a_terminal_scrolls(run):
    program = run(
        "bash", "-c", f"stty rows 5 cols 80; exec '{COMMAND[0]}' frames --period 0.3", terminal=True
    )
    program.wait_for(r"^1-2 of 3: arrow keys scroll, q quits")
    program.type("\x1b[B")
    program.wait_for(r"^2-3 of 3: arrow keys scroll, q quits")
    program.type("q")
    assert program.wait() == 0


@pytest.mark.usefixtures("talker")
def test_it_goes_on_after_ctrl_z_and_fg(run):
    """The shell sets the terminal up for itself meanwhile; `fg` takes single keys again."""
    program = run(
        "bash", "--norc", "-i", terminal=True, environment={"PS1": "ready\\n", "TERM": "dumb"}
    )
    program.wait_for(r"^ready$")
    program.type(f"'{COMMAND[0]}' frames --period 0.3\n")
    program.wait_for(r"─ map +static", count=2)
    program.type("\x1a")
    program.wait_for(r"^ready$", count=2)
    program.type("stty icanon echo\n")
    program.wait_for(r"^ready$", count=3)
    drawn = len(re.findall(r"─ map +static", program.text))
    program.type("fg\n")
    program.wait_for(r"─ map +static", count=drawn + 2)
    program.type("q")  # no line feed: it is read as a key
    program.wait_for(r"^ready$", count=4)
    program.type("exit\n")
    program.wait()


@pytest.mark.usefixtures("talker")
def test_a_full_disk_is_one_line(run):
    program = run("bash", "-c", f"exec '{COMMAND[0]}' frames --period 0.2 >/dev/full")
    assert program.wait() == 1
    assert program.text == "turtlewire: write error: No space left on device"
