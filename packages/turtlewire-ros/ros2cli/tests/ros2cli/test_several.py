"""`ros2 topic hz` and `bw` of several topics; `ros2 param get` and `set` of several parameters."""

import sys
import threading

import pytest
from tests.needs import needs_cyclone_dds
from tests.programs import offered

from ros2cli.main import main
from ros2topic.verb.bw import ROSTopicBandwidth
from ros2topic.verb.hz import ROSTopicHz
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS

ROS2 = (
    sys.executable,
    "-c",
    "import sys; from ros2cli.main import main; sys.exit(main(sys.argv[1:]))",
)
CLEAR = "\x1b[H\x1b[2J"


@pytest.fixture
def talkers():
    """Publish texts on /chat and /chatter, and register /strange, whose type is unknown."""
    context, end = open_context(), threading.Event()
    node = context.create_node("talker")
    kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
    publishers = [node.create_publisher(topic, kind, QoS()) for topic in ("/chat", "/chatter")]
    node.create_publisher("/strange", TypeId("no_msgs/msg/Such", "RIHS01_" + "0" * 64), QoS())
    message = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello"))

    def talk():
        while not end.wait(0.02):
            for publisher in publishers:
                publisher.publish(message)

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    end.set()
    thread.join()
    context.close()


class Clock:
    """A node whose clock shows what the test sets."""

    def __init__(self):
        self.nanoseconds = 0

    def get_clock(self):
        return self

    def now(self):
        return self


def test_the_table_of_rates(capsys):
    clock = Clock()
    hz = ROSTopicHz(clock, 10)
    for clock.nanoseconds in range(0, 900_000_000, 100_000_000):
        hz.callback_hz(None, "/chat")
        hz.callback_hz(None, "/tf")
    hz.callback_hz(None, "/once")
    hz.print_hz(["/chat", "/tf", "/once", "/silent"])
    table = (
        "topic    rate    min_delta   max_delta   std_dev   window",
        "=" * 57,
        "/chat   10.000   0.100       0.100       0.00000   9     ",
        "/tf     10.000   0.100       0.100       0.00000   9     ",
    )
    assert capsys.readouterr().out == "\n".join(table) + "\n\n"
    clock.nanoseconds = 900_000_000
    hz.callback_hz(None, "/tf")
    hz.print_hz(["/chat", "/tf"], clear_screen=True)
    lines = capsys.readouterr().out.splitlines()
    assert (lines[0][: len(CLEAR)], len(lines)) == (CLEAR, 4)
    assert lines[2].startswith("/tf  ")
    hz.print_hz(["/chat", "/tf"], clear_screen=True)
    assert capsys.readouterr().out == ""


def test_the_table_of_bandwidths(monkeypatch, capsys):
    now = iter((0.0, 0.5, 0.0, 0.5, 1.0, 1.0, 1.5))
    monkeypatch.setattr("time.monotonic", lambda: next(now))
    bandwidth = ROSTopicBandwidth(Clock(), 10)
    for topic, size in (("/chat", 86), ("/image", 50_000)):
        for _ in range(2):
            bandwidth.callback(bytes(size), topic)
    bandwidth.print_bw(["/chat", "/image", "/silent"])
    table = (
        "topic     bandwidth    window     mean       min        max   ",
        "=" * 62,
        "/chat    172 B/s       2        86 B       86 B       86 B    ",
        "/image   100.00 KB/s   2        50.00 KB   50.00 KB   50.00 KB",
    )
    assert capsys.readouterr().out == "\n".join(table) + "\n\n"
    bandwidth.print_bw(["/chat", "/image"])
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("verb", "row"),
    [
        ("hz", r"^/chat(ter)? +\d+\.\d{3}   \d\.\d{3} +\d\.\d{3} +\d\.\d{5}   \d+ *$"),
        ("bw", r"^/chat(ter)? +[\d.]+ K?B/s +\d+ +(1[46] B) +\2 +\2 *$"),
    ],
)
def test_two_topics(run, talkers, verb, row):
    # A topic that does not exist yet does not hold up the others.
    shown = run(*ROS2, "topic", verb, "/later", "/chat", "chatter")
    topics = {match.group(1) for match in shown.wait_for(row, count=4)}
    assert topics == {None, "ter"}
    assert "WARNING: topic [/later] does not appear to be published yet" in shown.text
    assert "\x1b" not in shown.text


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_all_topics(run, talkers, verb):
    shown = run(*ROS2, "topic", verb, "--all")
    shown.wait_for("^/chatter ", count=2)
    first, *_ = lines = shown.text.splitlines()
    assert first == "Subscribing to all 5 available topics..."
    assert "WARNING: failed to find message type for topic [/strange]" in lines
    assert any(line.startswith(f"{CLEAR}") and "window" in line for line in lines)


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_a_reader_of_a_table_that_ends_early_is_no_error(run, talkers, verb):
    command = f"{sys.executable} -c '{ROS2[2]}' topic {verb} /chat /chatter | grep -m 1 window"
    reader = run("bash", "-c", command)
    assert reader.wait() == 0
    (columns,) = reader.text.splitlines()
    assert columns.split()[0] == "topic"


@pytest.mark.parametrize("verb", ["hz", "bw"])
def test_wrong_words(capsys, verb):
    assert main(["topic", verb, "-a", "/chat"]) == 1
    assert capsys.readouterr() == ("", "Cannot specify both --all/-a and topic names\n")
    with pytest.raises(SystemExit) as end:
        main(["topic", verb])
    assert end.value.code == 2
    missing = f"ros2 topic {verb}: error: the following arguments are required: topic_name\n"
    assert capsys.readouterr().err.endswith(missing)


def test_completion_of_a_second_topic(talkers):
    assert {"/chat", "/chatter"} <= set().union(
        *(offered("ros2 topic hz /strange /ch") for _ in range(3))
    )


STAMPED = """
import rclpy
from geometry_msgs.msg import PointStamped
rclpy.init()
node = rclpy.create_node("volatile")
publisher = node.create_publisher(PointStamped, "/point", 1)
print("ready", flush=True)
rclpy.spin(node)
"""


@needs_cyclone_dds  # Zenoh connects endpoints of any QoS
@pytest.mark.parametrize("verb", ["bw", "delay"])
def test_qos_of_the_subscription(run, verb):
    run(sys.executable, "-c", STAMPED).wait_for("ready")
    options = ("--qos-durability", "transient_local")
    run(*ROS2, "topic", verb, "/point", *options).wait_for(
        "'/point', offering incompatible QoS.*DURABILITY"
    )


NODES = """
import rclpy
from rclpy.executors import SingleThreadedExecutor
rclpy.init()
executor = SingleThreadedExecutor()
for name, parameters in {"a": {"speed": 20.0, "on": True}, "b": {"speed": 3}, "c": {}}.items():
    node = rclpy.create_node(name)
    for parameter, value in parameters.items():
        node.declare_parameter(parameter, value)
    executor.add_node(node)
print("ready", flush=True)
executor.spin()
"""


@pytest.fixture
def nodes(run):
    run(sys.executable, "-c", NODES).wait_for("ready")


def told(capsys, words, status=0):
    assert main(["param", *words.split()]) == status
    return capsys.readouterr()


def test_several_parameters_of_a_node(nodes, capsys):
    text = "speed:\n  Double value is: 20.0\non:\n  Boolean value is: True\n"
    assert told(capsys, "get /a speed on") == (text, "")
    assert told(capsys, "get --hide-type /a on speed") == ("on: True\nspeed: 20.0\n", "")
    assert told(capsys, "get /a speed") == ("Double value is: 20.0\n", "")
    missing = "Parameter(s) 'on', 'sped' not available on node\nDid you mean: speed\n"
    assert told(capsys, "get /a on sped", 1) == ("", missing)


def test_a_parameter_of_all_nodes(nodes, capsys):
    text = "/a:\n  Double value is: 20.0\n/b:\n  Integer value is: 3\n"
    assert told(capsys, "get speed") == (text, "")
    assert told(capsys, "get on --hide-type --service-timeout 60") == ("/a: True\n", "")
    assert told(capsys, "get sped", 1) == ("", "Parameter 'sped' not set on any node\n")
    hint = "Parameter '/a' not set on any node\n/a is a node: also name one of its parameters\n"
    assert told(capsys, "get /a", 1) == ("", hint)


def test_several_parameters_are_set(nodes, capsys):
    text = "speed: Set parameter successful\non: Set parameter successful\n"
    assert told(capsys, "set /a speed 1.5 on false") == (text, "")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 1.5\n"
    out, err = told(capsys, "set /a speed fast on true")
    assert out == "on: Set parameter successful\n"
    assert err.startswith("speed: Setting parameter failed: Wrong parameter type, expected ")
    assert told(capsys, "set /a on true") == ("Set parameter successful\n", "")
    pairs = "Parameters must be provided as name/value pairs: name value [name value ...]."
    assert told(capsys, "set /a speed 1.0 on", 1) == ("", f"{pairs} Got 3 argument(s).\n")


def test_all_parameters_are_set_or_none(nodes, capsys):
    text = "Set parameters atomically successful\n"
    assert told(capsys, "set --atomic /a speed 2.5 on false") == (text, "")
    out, err = told(capsys, "set --atomic /a speed 9.5 on maybe")
    assert out == ""
    assert err.startswith("Setting parameters atomically failed: Wrong parameter type, expected ")
    assert told(capsys, "get /a on speed --hide-type").out == "on: False\nspeed: 2.5\n"


def test_completion_of_a_second_parameter(nodes):
    assert "on" in set().union(*(offered("ros2 param get /a speed o") for _ in range(3)))
