"""tf2_echo, tf2_monitor, static_transform_publisher and buffer_server.

As processes over Cyclone DDS, and their parts.
"""

import argparse
import json
import math
import os
import re
import signal
import subprocess
import sys
import threading
import time

import pytest
from tests.places import BIN

from rclpy.duration import Duration
from rclpy.time import Time
from tf2_ros import (
    Buffer,
    BufferClient,
    StaticTransformBroadcaster,
    TransformListener,
    command_line,
    tf2_echo,
    tf2_monitor,
)
from tf2_ros import static_transform_publisher as publisher
from turtlewire import msg, wire
from turtlewire.tf.listener import QOS, TYPE_NAME
from turtlewire.wire.base import MessageInfo, TypeId

pytestmark = pytest.mark.usefixtures("real_middleware")

LONG = Duration(seconds=60)
FRAMES = "--frame-id a --child-frame-id b"
TOOLS = {
    "tf2_echo": "tf2_ros.tf2_echo",
    "tf2_monitor": "tf2_ros.tf2_monitor",
    "static_transform_publisher": "tf2_ros.static_transform_publisher",
    "buffer_server": "tf2_ros.buffer_server",
}


@pytest.fixture
def tool():
    processes = []

    def start(name, *arguments):
        code = f"""import sys
from {TOOLS[name]} import main
from turtlewire.program import program
sys.exit(program(main)())"""
        process = subprocess.Popen(
            [sys.executable, "-c", code, *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=dict(os.environ),
        )
        processes.append(process)
        return process

    yield start
    for process in processes:
        if process.poll() is None:
            process.kill()
        process.communicate()


def stop(process):
    """Interrupt it; status and both outputs."""
    process.send_signal(signal.SIGINT)
    return finish(process)


def finish(process):
    out, err = process.communicate(timeout=300)
    assert "Traceback" not in err
    return process.returncode, out, err


def read_until(process, pattern, stream="stdout"):
    """What it prints, up to the first line that matches."""
    text = ""
    for line in getattr(process, stream):
        text += line
        if re.search(pattern, line):
            return text
    raise AssertionError(text)


@pytest.fixture
def talker(real_middleware, stamped):
    """Publishes a moving frame, until the test ends."""
    context = wire.open_context()
    tf = context.create_node("talker").create_publisher(
        "/tf", TypeId(TYPE_NAME, msg.type_hash(TYPE_NAME)), QOS
    )
    ended = threading.Event()

    def talk():
        while not ended.wait(0.02):
            transform = stamped("world", "robot", x=2.0)
            transform.transform.translation.y = -1.0
            transform.header.stamp = Time(seconds=time.time()).to_msg()
            tf.publish(msg.serialize(msg.get_message(TYPE_NAME)(transforms=[transform])))

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    ended.set()
    thread.join()
    context.close()


@pytest.fixture
def listening(node):
    buffer = Buffer()
    TransformListener(buffer, node)
    return buffer, node


def test_a_static_transform_is_published_until_stopped(tool, listening):
    place = "--x 1 --y -0.5 --yaw 1.5707963267948966"
    process = tool("static_transform_publisher", *place.split(), *FRAMES.split())
    found = listening[0].lookup_transform("a", "b", Time(), LONG).transform
    assert (found.translation.x, found.translation.y, found.translation.z) == (1.0, -0.5, 0.0)
    assert (found.rotation.z, found.rotation.w) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))
    err = read_until(process, r"^from 'a' to 'b'$", "stderr")
    assert stop(process)[0] == 0
    assert re.search(
        r"\[static_transform_publisher_\w{16}\]: Spinning until stopped - publishing transform\n"
        r"translation: \('1\.000000', '-0\.500000', '0\.000000'\)\nrotation: \('0\.000000', "
        r"'0\.000000', '0\.707107', '0\.707107'\)\n"
        r"from 'a' to 'b'",
        err,
    )


def test_static_publisher_subscribes_to_parameter_events(tool):
    tool("static_transform_publisher", *FRAMES.split())
    context = wire.open_context()
    try:
        assert context.graph.wait_for(
            lambda: any(
                (end.topic, end.kind) == ("/parameter_events", "subscription")
                and end.node is not None
                and end.node.name.startswith("static_transform_publisher_")
                for end in context.graph.endpoints()
            ),
            60_000_000_000,
        )
    finally:
        context.close()


def test_a_frame_cannot_stand_in_itself(tool):
    status, _, err = finish(
        tool("static_transform_publisher", "--frame-id", "a", "--child-frame-id", "a")
    )
    assert status == 1
    assert "child_frame_id cannot equal frame_id" in err


def test_both_styles_of_arguments():
    place = "--x 1 --y 2 --z 3 --roll 0.1 --pitch 0.2 --yaw 0.3"
    new = publisher.parse([*place.split(), *FRAMES.split()])
    old = publisher.parse(["1", "2", "3", "0.3", "0.2", "0.1", "a", "b"])
    assert new == old._replace(old_style=False)
    assert old.old_style
    quaternion = publisher.parse(["1", "2", "3", "0", "0", "1", "0", "a", "b"])
    assert (quaternion.translation, quaternion.rotation) == ((1.0, 2.0, 3.0), (0.0, 0.0, 1.0, 0.0))
    turned = publisher.parse(["--qz", "1", "--qw", "0", *FRAMES.split()])
    assert turned.rotation == (0.0, 0.0, 1.0, 0.0)
    assert publisher.parse(FRAMES.split()).rotation == (0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("", "Frame id must not be empty"),
        ("--frame-id a", "Child frame id must not be empty"),
        ("--frame-id a --child-frame-id b --x", "Not enough arguments for --x"),
        ("--frame-id a --child-frame-id b --x one", "Failed to parse --x argument as float"),
        (
            "--frame-id a --child-frame-id b --qx 1 --yaw 1",
            "Cannot specify both quaternion and Euler rotations",
        ),
        ("--frame-id a --child-frame-id b more", "Extra unparsed arguments on command-line"),
        (
            "--frame-id a --child-frame-id b --yaw inf",
            "--yaw is inf: listeners reject a transform whose numbers are not finite",
        ),
        (
            "--frame-id a --child-frame-id b --qw 0",
            "A quaternion of zeros is not a rotation, and every listener rejects it",
        ),
        ("1 2 3", "Extra unparsed arguments on command-line"),
        (
            "1 2 3 0 0 0 a b --x 1",
            "Cannot specify both new-style (flags) and old-style (arguments)",
        ),
        ("1 2 3 x 0 0 a b", "Failed to parse yaw argument as float"),
    ],
)
def test_wrong_arguments_are_named(words, text, capsys):
    assert publisher.main(["static_transform_publisher", *words.split()]) == 1
    assert f"error parsing command line arguments: {text}\nusage: " in capsys.readouterr().err


def test_kilted_refuses_a_quaternion_that_its_listeners_reject(monkeypatch, capsys):
    words = [*FRAMES.split(), "--qx", "1"]
    assert publisher.parse(words).rotation == (1.0, 0.0, 0.0, 1.0)
    monkeypatch.setenv("ROS_DISTRO", "kilted")
    assert publisher.main(["static_transform_publisher", *words]) == 1
    assert "The quaternion must have the length 1" in capsys.readouterr().err
    assert publisher.parse([*words, "--qw", "0.01"]).rotation == (1.0, 0.0, 0.0, 0.01)


@pytest.mark.parametrize(
    ("size", "text"),
    [
        ("-1.0", "buffer_size is -1.0; it can be 0 to 1000000000 seconds"),
        (
            "10",
            (
                "expecting type 'DOUBLE': buffer_size\n"
                "YAML reads a double with a point in it: -p buffer_size:=10.0"
            ),
        ),
    ],
)
def test_a_buffer_server_refuses_sizes(size, text, tool):
    status, _, err = finish(tool("buffer_server", "--ros-args", "-p", f"buffer_size:={size}"))
    assert status == 1
    assert text in err


def test_lyrical_ignores_what_are_no_flags(monkeypatch):
    monkeypatch.setenv("ROS_DISTRO", "lyrical")
    placement = publisher.parse(f"1 2 3 0 0 0 c d {FRAMES} --x 4".split())
    assert placement == publisher.Placement((4.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), "a", "b")
    with pytest.raises(publisher.ArgumentsError, match=r"^Frame id must not be empty$"):
        publisher.parse(["1", "2", "3", "0", "0", "0", "a", "b"])


def test_help_is_no_error(capsys):
    assert publisher.main(["static_transform_publisher", "--help"]) == 0
    assert "old style, deprecated" in capsys.readouterr().out


@pytest.mark.usefixtures("talker")
def test_echo_prints_what_ros_2_prints(tool):
    status, out, _ = finish(tool("tf2_echo", "world", "robot", "50", "--limit", "2", "--distance"))
    assert status == 0
    block = (
        r"At time \d+\.\d{9}\n- Translation: \[2\.000, -1\.000, 0\.000\]\n- Rotation: in "
        r"Quaternion \[0\.000, 0\.000, 0\.000, 1\.000\]\n"
        r"- Rotation: in RPY \(radian\) \[0\.000, -0\.000, 0\.000\]\n- Rotation: in RPY "
        r"\(degree\) \[0\.000, -0\.000, 0\.000\]\n- Matrix:\n"
        r"  1\.000  0\.000  0\.000  2\.000\n  0\.000  1\.000  0\.000 -1\.000\n"
        r"  0\.000  0\.000  1\.000  0\.000\n  0\.000  0\.000  0\.000  1\.000\n"
        r"- Distance: 2\.236\n- In words: seen from world, robot is 2\.000 m ahead, 1\.000 m to "
        r"the right\n"
    )
    assert re.fullmatch(block * 2, out), out


@pytest.mark.usefixtures("talker")
def test_echo_as_json(tool):
    status, out, _ = finish(tool("tf2_echo", "world", "robot", "50", "-n", "1", "--json"))
    assert status == 0
    data = json.loads(out)
    assert data["translation"] == [2.0, -1.0, 0.0]
    assert (data["source_frame"], data["target_frame"]) == ("world", "robot")


def test_echo_says_what_it_waits_for(tool):
    process = tool("tf2_echo", "world", "nothing")
    line = process.stderr.readline()
    assert re.search(
        r"\[tf2_echo\]: Waiting for transform world ->  nothing: Invalid frame ID \"world\" "
        r"passed to canTransform",
        line,
    )
    assert stop(process)[0] == 0


@pytest.mark.parametrize(
    ("words", "status", "text"),
    [
        ("world", 1, "usage: tf2_echo"),
        (
            "world robot fast",
            2,
            "Failed to convert rate argument 'fast' to a floating-point number",
        ),
        ("world robot 0", 3, "must be > 0.0"),
        (
            "/world robot",
            1,
            "in tf2 frame_ids cannot start with a '/': write 'world' instead of '/world'",
        ),
        ("world robot --limit -1", 1, "'-1' is not a whole number, 0 or more"),
        ("world robot --precision 18", 1, "'18' is not a whole number from 0 to 17"),
    ],
)
def test_echo_refuses(words, status, text, capsys):
    try:
        found = tf2_echo.main(["tf2_echo", *words.split()])
    except SystemExit as end:
        found = end.code
    assert found == status
    assert text in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ("robot", "give two frames, or none to monitor all"),
        ("robot world here", "give two frames, or none to monitor all"),
        ("/robot world", "in tf2 frame_ids cannot start with a '/'"),
        ("--period 0", "'0' is not a number of seconds, above 0 and up to 3600"),
        ("--period nan", "'nan' is not a number of seconds, above 0 and up to 3600"),
        ("--period soon", "'soon' is not a number of seconds, above 0 and up to 3600"),
        ("--limit x", "'x' is not a whole number, 0 or more"),
    ],
)
def test_monitor_refuses(words, text, capsys):
    try:
        status = tf2_monitor.main(["tf2_monitor", *words.split()])
    except SystemExit as end:
        status = end.code
    assert status == 1
    assert text in capsys.readouterr().err


def test_frame_ids_on_the_command_line():
    assert command_line.frame_id("a/b") == "a/b"
    with pytest.raises(argparse.ArgumentTypeError, match="cannot be empty"):
        command_line.frame_id("")


def test_a_place_in_words(stamped):
    transform = stamped("a", "b", x=-1.0)
    assert tf2_echo.in_words(transform) == "seen from a, b is 1.00 m behind"
    (
        transform.transform.translation.x,
        transform.transform.translation.y,
        transform.transform.translation.z,
    ) = 0.0, 2.0, -0.5
    assert tf2_echo.in_words(transform) == "seen from a, b is 2.00 m to the left, 0.50 m below"
    transform.transform.translation.y = transform.transform.translation.z = 0.0
    assert tf2_echo.in_words(transform) == "seen from a, b is at the same place"
    options = argparse.Namespace(precision=1, degrees=True, distance=False)
    assert "radian" not in tf2_echo.describe(transform, options)


@pytest.mark.usefixtures("talker")
def test_monitor_names_who_publishes(tool):
    process = tool("tf2_monitor", "--period", "0.5")
    text = read_until(process, r"^Node: /talker \S+ Hz, Average Delay: \S+ Max Delay: \S+$")
    assert "RESULTS: for all Frames" in text
    assert re.search(
        r"Frame: robot, published by /talker, Average Delay: \S+, Max Delay: \S+\n", text
    )
    assert stop(process)[0] == 0


@pytest.mark.usefixtures("talker")
def test_monitor_of_a_chain_as_json(tool):
    process = tool("tf2_monitor", "robot", "world", "--period", "0.5", "--json")
    data = json.loads(read_until(process, r'"chain": \["robot", "world"\]').splitlines()[-1])
    assert data["net_delay"]["max"] >= data["net_delay"]["average"] > 0.0
    assert stop(process)[0] == 0
    assert finish(tool("tf2_monitor", "robot"))[0] == 1


@pytest.mark.usefixtures("talker")
@pytest.mark.parametrize(
    ("command", "first"),
    [
        ("tf2_ros tf2_echo world robot 50", r"At time \d+\.\d{9}"),
        ("tf2_ros tf2_echo world robot 50 --json", r"\{.*\}"),
        (
            "tf2_ros tf2_monitor --period 0.2",
            r"Gathering data on all frames for 0\.2 seconds\.\.\.",
        ),
    ],
)
def test_the_end_of_a_pipe_is_a_quiet_end(command, first, run):
    pipe = run("bash", "-c", f"set -o pipefail; {BIN / 'ros2'} run {command} | head -n 1")
    assert pipe.wait() == 141  # of a program that wrote into a closed pipe
    assert re.fullmatch(first, pipe.text)


def test_chains_go_up_and_down_again(stamped):
    buffer = Buffer()
    for parent, child in (("root", "a"), ("a", "b"), ("a", "c"), ("c", "d")):
        buffer.set_transform_static(stamped(parent, child), "me")
    assert tf2_monitor.chain(buffer, "b", "d") == ["b", "a", "c", "d"]
    assert tf2_monitor.chain(buffer, "d", "root") == ["d", "c", "a", "root"]
    assert tf2_monitor.chain(buffer, "a", "a") == ["a"]


def test_a_chain_may_have_any_frame_id(stamped):
    buffer = Buffer()
    buffer.set_transform_static(stamped("world", "a exists with parent b."), "me")
    assert tf2_monitor.chain(buffer, "a exists with parent b.", "world") == [
        "a exists with parent b.",
        "world",
    ]


def test_static_chain_has_no_net_delay(stamped):
    buffer, net = Buffer(), tf2_monitor.Delays()
    buffer.set_transform_static(stamped("world", "robot"), "me")
    tf2_monitor._note_chain(["robot", "world"], buffer, net, buffer.clock)
    assert net.count == 0
    buffer.set_transform(stamped("world", "cup", stamp_s=1), "me")
    tf2_monitor._note_chain(["cup", "robot"], buffer, net, buffer.clock)
    assert net.count == 1


def test_the_hint_of_echo_names_other_domains_while_there_are_no_frames(stamped, monkeypatch):
    monkeypatch.setattr("turtlewire.doctor.network.udp_ports", lambda: {7410 + 250 * 3})
    buffer = Buffer()
    hints = tf2_echo._hints(buffer, "world", "robot", 4)
    assert "does a TransformListener fill this buffer?" in hints[0]
    assert hints[-1].endswith("export ROS_DOMAIN_ID=3")
    assert len(tf2_echo._hints(buffer, "world", "robot", 3)) == 1
    buffer.set_transform_static(stamped("world", "robot"), "me")
    assert len(tf2_echo._hints(buffer, "world", "robt", 4)) == 1


def test_echo_gives_a_hint_once(tool):
    process = tool("tf2_echo", "world", "nothing")
    lines, waits = [], 0
    while waits < 2:
        lines.append(process.stderr.readline())
        waits += "Waiting for transform" in lines[-1]
    _, _, rest = stop(process)
    assert "".join([*lines, rest]).count("No transform has arrived yet") == 1


def test_the_tools_help_with_a_frame_id_that_is_not_known(stamped):
    buffer = Buffer()
    buffer.set_transform_static(stamped("world", "robot"), "me")
    (hint,) = tf2_echo._hints(buffer, "world", "robt", 0)
    assert "robot" in hint
    assert tf2_echo._hints(buffer, "world", "robot", 0) == []
    statistics = tf2_monitor.DelayStatistics(lambda _gid: tf2_monitor.NOBODY, lambda: 0.0, bool)
    options = argparse.Namespace(frames=["world", "robt"], json=False)
    assert hint in tf2_monitor._report(options, buffer, statistics, tf2_monitor.Delays())


def test_statistics(stamped):
    now = [10.0]
    names = {b"one": "/one"}
    present = {b"one", b"two"}
    statistics = tf2_monitor.DelayStatistics(
        lambda gid: names.get(gid, tf2_monitor.NOBODY), lambda: now[0], present.__contains__
    )
    message = msg.get_message(TYPE_NAME)(transforms=[stamped(stamp_s=9)])
    for now[0] in (10.0, 11.0, 12.0):
        statistics.take(message, MessageInfo(0, 0, b"one"))
    statistics.take(message, MessageInfo(0, 0, b"two"))
    data = statistics.as_dict()
    assert data["frames"] == [
        {
            "frame": "robot",
            "published_by": tf2_monitor.NOBODY,
            "departed": False,
            "average_delay": 2.25,
            "max_delay": 3.0,
        }
    ]
    assert data["broadcasters"][0] == {
        "node": "/one",
        "rate": 1.0,
        "average_delay": 2.0,
        "max_delay": 3.0,
    }
    assert data["broadcasters"][1]["rate"] == 0.0
    names[b"two"] = "/one"  # the graph has learnt whose publisher it is
    data = statistics.as_dict()
    assert data["frames"][0]["published_by"] == "/one"
    assert data["broadcasters"] == [
        {"node": "/one", "rate": 1.5, "average_delay": 2.25, "max_delay": 3.0}
    ]
    present.clear()
    assert statistics.as_dict()["frames"][0]["departed"]
    options = argparse.Namespace(frames=[], json=False)
    report = tf2_monitor._report(options, Buffer(), statistics, tf2_monitor.Delays())
    assert "Frame: robot, published by /one (has left), Average Delay: 2.25, " in report


def test_broadcasters_are_counted_by_messages_not_transforms(stamped):
    """A node that sends three transforms in each message, 20 messages a second, sends at 20 Hz."""
    now = [0.0]
    statistics = tf2_monitor.DelayStatistics(lambda _gid: "/three", lambda: now[0], bool)
    transforms = [stamped(child=f"frame{number}", stamp_s=-number) for number in range(3)]
    message = msg.get_message(TYPE_NAME)(transforms=transforms)
    for tick in range(21):
        now[0] = tick / 20
        statistics.take(message, MessageInfo(0, 0, b"three"))
    (broadcaster,) = statistics.as_dict()["broadcasters"]
    assert broadcaster["rate"] == pytest.approx(20.0)
    # ROS 2 computes a broadcaster's figures from the mean delays of its messages
    assert broadcaster["average_delay"] == pytest.approx(1.5)
    assert broadcaster["max_delay"] == pytest.approx(2.0)


STEERING = "robot\x1b]0;title\x07\x1b[2J"
STEERING_SHOWN = r"robot\x1b]0;title\x07\x1b[2J"


def test_monitor_escapes_names_that_would_steer_the_terminal(stamped):
    statistics = tf2_monitor.DelayStatistics(lambda _gid: STEERING, lambda: 0.0, bool)
    message = msg.get_message(TYPE_NAME)(transforms=[stamped(child=STEERING)])
    statistics.take(message, MessageInfo(0, 0, b"one"))
    options = argparse.Namespace(frames=[], json=False)
    report = tf2_monitor._report(options, Buffer(), statistics, tf2_monitor.Delays())
    assert f"Frame: {STEERING_SHOWN}, published by {STEERING_SHOWN}, " in report
    assert "\x1b" not in report


def test_echo_escapes_names_that_would_steer_the_terminal(tool, listening, stamped):
    node = listening[1]
    broadcaster = StaticTransformBroadcaster(node)
    broadcaster.sendTransform([stamped(STEERING, "world"), stamped("elsewhere", "robot")])
    process = tool("tf2_echo", "world", "robot")
    text = read_until(process, r"is in the tree with the root", "stderr")
    assert STEERING_SHOWN in text
    assert "\x1b]0" not in text


@pytest.mark.usefixtures("talker")
def test_buffer_server_answers_other_processes_until_its_end(tool, listening):
    process = tool("buffer_server")
    client = BufferClient(listening[1], "tf2_buffer_server", timeout_padding=Duration(seconds=1))
    assert client.lookup_transform("world", "robot", Time(), LONG).transform.translation.x == 2.0
    process.kill()
    process.wait()
    assert client.can_transform("world", "robot", Time(), Duration(seconds=0.1)) is False
    client.destroy()
