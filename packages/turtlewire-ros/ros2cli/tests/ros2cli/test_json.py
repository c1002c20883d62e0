"""The option `--json`, and what docs/reference/ros2_json.md shows of it."""

import json
import math
import os
import re
import subprocess
import sys
from functools import partial
from types import SimpleNamespace

import pytest
from tests.how_to import blocks, blocks_of, wait_until_printed
from tests.needs import needs_cyclone_dds
from tests.places import HOW_TO, PATH, ROOT
from tests.programs import ROS2, ROS2_IN_SHELL

from rclpy.task import Future
from rclpy.time import Time
from ros2cli.json_lines import print_json
from ros2cli.main import main, make_parser
from ros2cli.output import escaped_output
from ros2topic.verb.bw import ROSTopicBandwidth
from ros2topic.verb.delay import ROSTopicDelay
from ros2topic.verb.echo import _lost, _Printer
from ros2topic.verb.hz import ROSTopicHz
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Header, String

SERVERS = """
import math
import rclpy
from rclpy.action import ActionServer
from sensor_msgs.msg import LaserScan
from std_srvs.srv import SetBool
from turtlesim.action import RotateAbsolute
rclpy.init()
node = rclpy.create_node("servers", namespace="/some")
def answer(request, response):
    response.success = request.data
    return response
server = node.create_service(SetBool, "/set", answer)
client = node.create_client(SetBool, "/set")
action = ActionServer(node, RotateAbsolute, "/rotate", lambda goal: None)
publisher = node.create_publisher(LaserScan, "/scan", 1)
node.declare_parameter("laser.gains", [1.0, math.inf])
node.declare_parameter("laser.key", [b"\\x01", b"\\xff"])
timer = node.create_timer(0.02, lambda: publisher.publish(LaserScan(ranges=[1.5, math.nan])))
print("ready", flush=True)
rclpy.spin(node)
"""
SCAN = ["sensor_msgs/msg/LaserScan"]
SET = ["std_srvs/srv/SetBool"]
ROTATE = ["turtlesim/action/RotateAbsolute"]


@pytest.fixture
def servers(run):
    run(sys.executable, "-c", SERVERS).wait_for("ready")


def lines(capsys):
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


def printed(capsys, words, status=0):
    assert main([*words.split(), "--json"]) == status
    return lines(capsys)


def only(capsys, words):
    (line,) = printed(capsys, words)
    return line


def options(*words):
    return make_parser(list(words)).parse_args(words)


def test_values_that_json_does_not_have(capsys):
    numbers = [1.5, math.nan, math.inf, -math.inf]
    print_json({"scan": LaserScan(ranges=numbers), "bytes": [b"\x01", b"\xff"], "raw": b"\x00\x01"})
    (line,) = lines(capsys)
    assert line["scan"]["ranges"] == [1.5, "NaN", "Infinity", "-Infinity"]
    assert line["scan"]["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    assert (line["bytes"], line["raw"]) == ([1, 255], [0, 1])


def test_any_string_is_json_on_one_line_and_controls_no_terminal(capsys):
    text = "".join(map(chr, range(256))) + "\u202e\u2028 🐢"
    with escaped_output():
        print_json(String(data=text))
    out = capsys.readouterr().out
    assert out.isascii()
    assert out.count("\n") == 1
    assert out[:-1].isprintable()
    assert json.loads(out) == {"data": text}


def test_topics(servers, capsys):
    assert {"topic": "/scan", "types": SCAN} in printed(capsys, "topic list")
    counted = {"topic": "/scan", "types": SCAN, "publisher_count": 1, "subscription_count": 0}
    assert counted in printed(capsys, "topic list -v")
    assert set(only(capsys, "topic list -c")) == {"count"}
    assert only(capsys, "topic info /scan") == counted
    info = only(capsys, "topic info -v /scan")
    (publisher,) = info.pop("publishers")
    assert info == {**counted, "subscriptions": []}
    assert publisher["node"] == "/some/servers"
    assert publisher["type"] == SCAN[0]
    assert publisher["type_hash"].startswith("RIHS01_")
    assert len(bytes.fromhex(publisher["gid"].replace(".", ""))) == 16
    assert publisher["qos"] == {
        "reliability": "reliable",
        "history": "keep_last",
        "depth": 1,
        "durability": "volatile",
        "lifespan_ns": None,
        "deadline_ns": None,
        "liveliness": "automatic",
        "liveliness_lease_duration_ns": None,
    }


def test_nodes(servers, capsys):
    assert printed(capsys, "node list") == [{"node": "/some/servers"}]
    info = only(capsys, "node info /some/servers")
    assert {"topic": "/scan", "types": SCAN} in info["publishers"]
    assert {"service": "/set", "types": SET} in info["service_servers"]
    assert info["service_clients"] == [{"service": "/set", "types": SET}]
    assert info["action_servers"] == [{"action": "/rotate", "types": ROTATE}]
    assert (info["node"], info["subscribers"], info["action_clients"]) == ("/some/servers", [], [])


def test_services(servers, capsys):
    row = {"service": "/set", "types": SET}
    assert row in printed(capsys, "service list")
    assert only(capsys, "service type /set") == row
    counted = {**row, "client_count": 1, "server_count": 1}
    assert only(capsys, "service info /set") == counted
    info = only(capsys, "service info -v /set")
    for ends in (info.pop("clients"), info.pop("servers")):
        (end,) = ends
        assert (end["node"], end["type"], end["type_hash"]) == ("/some/servers", SET[0], None)
        assert [set(each) for each in end["endpoints"]] == [{"gid", "qos"}] * 2
    assert info == counted
    assert main(["service", "call", "--json", "set", SET[0], "{data: true}"]) == 0
    assert lines(capsys) == [
        {"service": "/set", "request": {"data": True}, "response": {"success": True, "message": ""}}
    ]


def test_actions(servers, capsys):
    assert printed(capsys, "action list") == [{"action": "/rotate", "types": ROTATE}]
    counts = {"action": "/rotate", "client_count": 0, "server_count": 1}
    assert only(capsys, "action info -c /rotate") == counts
    servers_ = [{"node": "/some/servers", "types": ROTATE}]
    assert only(capsys, "action info /rotate") == {**counts, "clients": [], "servers": servers_}


def test_parameters(servers, capsys):
    gains = {"node": "/some/servers", "parameter": "laser.gains"}
    assert gains in printed(capsys, "param list")
    assert {**gains, "type": "double array"} in printed(capsys, "param list --param-type")
    gains |= {"type": "double array", "value": [1.0, "Infinity"]}
    key = {**gains, "parameter": "laser.key", "type": "byte array", "value": [1, 255]}
    assert printed(capsys, "param get /some/servers laser.gains laser.key") == [gains, key]
    assert printed(capsys, "param get laser.key") == [key]
    (parameters,) = only(capsys, "param dump /some/servers")["/some/servers"].values()
    assert parameters["laser"] == {"gains": [1.0, "Infinity"], "key": [1, 255]}


def test_errors_print_no_json(servers, capsys):
    for words in ("topic info /scn", "service type /se", "param get /some/servers lasr"):
        assert main([*words.split(), "--json"]) == 1
        out, error = capsys.readouterr()
        assert out == ""
        assert error


@pytest.mark.parametrize("verb", ["hz", "bw", "delay"])
def test_warnings_are_on_stderr(verb):
    words = [*ROS2, "topic", verb, "--json", "/later"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        warning = run.stderr.readline()
        run.terminate()
        assert run.stdout.read() == ""
    assert warning == "WARNING: topic [/later] does not appear to be published yet\n"


def test_nothing_but_json_is_printed_of_an_unknown_topic(capsys):
    assert main(["topic", "echo", "--json", "/later"]) == 1
    out, error = capsys.readouterr()
    assert out == ""
    assert error.startswith("WARNING: topic [/later] does not appear to be published yet\n")


def test_interfaces(capsys):
    fields = [
        {"name": name, "type": "float64", "default": default}
        for name, default in (("x", 0.0), ("y", 0.0), ("z", 0.0), ("w", 1.0))
    ]
    pose = only(capsys, "interface show geometry_msgs/msg/Pose")
    assert pose["interface"] == "geometry_msgs/msg/Pose"
    assert pose["fields"][1] == {
        "name": "orientation",
        "type": "geometry_msgs/Quaternion",
        "default": None,
        "interface": "geometry_msgs/msg/Quaternion",
        "fields": fields,
        "constants": [],
    }
    status = only(capsys, "interface show sensor_msgs/msg/NavSatStatus")
    assert {"name": "STATUS_NO_FIX", "type": "int8", "value": -1} in status["constants"]
    assert set(only(capsys, "interface show std_srvs/srv/SetBool")) == {
        "interface",
        "request",
        "response",
    }
    assert set(only(capsys, f"interface show {ROTATE[0]}")) == {
        "interface",
        "goal",
        "result",
        "feedback",
    }
    assert main(["interface", "show", "--json", "std_msgs/msg/Strin"]) == 1
    assert "Did you mean: std_msgs/msg/String" in capsys.readouterr().err


INFO = {"source_timestamp": 1, "received_timestamp": 2, "publication_sequence_number": None}


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ((), {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "a"}),
        (("--field", "stamp.sec", "--field", "frame_id"), {"stamp.sec": 0, "frame_id": "a"}),
        (("-i", "--field", "frame_id"), {"info": INFO, "message": {"frame_id": "a"}}),
    ],
    ids=["message", "fields", "info"],
)
def test_messages(capsys, words, expected):
    end = Future()
    args = options("topic", "echo", "/x", "--once", "--json", *words)
    _Printer(args, None, end).show(Header(frame_id="a"), INFO)
    assert lines(capsys) == [expected]
    assert end.done()


def test_lost_messages_are_reported_on_stderr(capsys):
    report = _lost(options("topic", "echo", "/x", "--json")).message_lost
    report(SimpleNamespace(total_count_change=1, total_count=2))
    out, error = capsys.readouterr()
    assert out == ""
    assert error == "A message was lost!!!\n\ttotal count change:1\n\ttotal count: 2\n"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--csv"], "--csv"),
        (["--raw"], "--raw"),
        (["--flow-style"], "--flow-style"),
        (["--no-arr", "--no-str"], "--no-arr or --no-str"),
        (["-l", "3"], "--truncate-length"),
        (["--clear"], "--clear"),
    ],
)
def test_options_of_the_text_are_rejected(capsys, words, named):
    assert main(["topic", "echo", "/x", "--json", *words]) == 1
    why = "--json prints each message whole, as one JSON object per line"
    assert capsys.readouterr() == ("", f"Cannot specify both --json and {named}: {why}\n")


def test_comments_of_interfaces_are_rejected(capsys):
    with pytest.raises(SystemExit):
        main(["interface", "show", "--json", "--no-comments", "std_msgs/msg/String"])
    assert "--no-comments: not allowed with argument --json" in capsys.readouterr().err


def test_a_closed_pipe_ends_the_command(run, servers):
    program = run("bash", "-c", f"{ROS2_IN_SHELL} topic echo --json /scan | head -1")
    assert program.wait() == 0
    (line,) = program.text.splitlines()
    assert json.loads(line)["ranges"] == [1.5, "NaN"]


def test_each_line_is_written_at_once(servers):
    words = [*ROS2, "topic", "hz", "--json", "--all"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as verb:
        line = json.loads(verb.stdout.readline())  # a buffer of some kilobytes would fill later
        verb.terminate()
    assert set(line) == {"topic", "rate", "min_delta", "max_delta", "std_dev", "window"}


class Clock:
    """A node whose clock shows what the test sets."""

    nanoseconds = 0

    def get_clock(self):
        return self

    def now(self):
        return Time(nanoseconds=self.nanoseconds)


def test_rates(capsys):
    clock = Clock()
    hz = ROSTopicHz(clock, 10)
    for clock.nanoseconds in (0, 500_000_000, 1_000_000_000):
        hz.callback_hz(None, "/chat")
    hz.print_json(["/chat", "/silent"])
    figures = {"rate": 2.0, "min_delta": 0.5, "max_delta": 0.5, "std_dev": 0.0, "window": 3}
    assert lines(capsys) == [{"topic": "/chat", **figures}]


def test_bandwidths(capsys, monkeypatch):
    seconds = iter((0.0, 1.0, 2.0))
    monkeypatch.setattr("time.monotonic", lambda: next(seconds))
    bandwidth = ROSTopicBandwidth(None, 10)
    for size in (1_000, 3_000):
        bandwidth.callback(bytes(size), "/chat")
    bandwidth.print_json(["/chat"])
    figures = {"bandwidth": 2_000.0, "window": 2, "mean": 2_000, "min": 1_000, "max": 3_000}
    assert lines(capsys) == [{"topic": "/chat", **figures}]


def test_delays(capsys):
    clock = Clock()
    delay = ROSTopicDelay(clock, 10)
    for clock.nanoseconds in (500_000_000, 1_500_000_000):
        delay.callback_delay(SimpleNamespace(header=Header()))
    delay.print_json("/chat")
    figures = {"average": 1.0, "min": 0.5, "max": 1.5, "std_dev": 0.5, "window": 2}
    assert lines(capsys) == [{"topic": "/chat", **figures}]
    delay.print_json("/chat")
    assert lines(capsys) == []


# The page shows what the commands print.

PAGE = (ROOT / "docs" / "reference" / "ros2_json.md").read_text()
BLOCKS = blocks(PAGE)


def test_the_page_shows_what_the_commands_print(run):
    assert len(BLOCKS) == 11
    (_, start), *others = BLOCKS
    start = start.removesuffix(" &\n")
    run("bash", "-c", f"exec {start}", environment={"PATH": PATH}).wait_for("Spawning turtle")
    for (_, command), (kind, text) in zip(others[::2], others[1::2], strict=True):
        assert kind == "text"
        wait_until_printed(text, partial(printed_by_program, run, command))


def printed_by_program(run, command):
    program = run("bash", "-c", command, environment={"PATH": PATH})
    program.wait()
    return f"{program.text}\n"


VERBS = [
    verb
    for row in re.findall(r"^\| (`(?!turtlewire)\w+ \w+`(?:, `\w+ \w+`)*) \|", PAGE, re.MULTILINE)
    for verb in re.findall(r"`(\w+ \w+)`", row)
]


@pytest.mark.parametrize("verb", VERBS)
def test_each_verb_of_the_page_has_the_option(verb):
    words = verb.split()
    with pytest.raises(SystemExit) as end:
        make_parser(words).parse_args([*words, "--json", "--help"])
    assert end.value.code == 0


def test_the_page_has_all_verbs():
    assert len(VERBS) == len(set(VERBS)) == 18


# The commands of docs/how-to/relay.md.

RELAY = (HOW_TO / "relay.md").read_text()


def with_domains(far):
    """The page with the domains of this test."""
    page = RELAY.replace("cyclonedds:0", f"cyclonedds:{os.environ['ROS_DOMAIN_ID']}")
    return page.replace("zenoh:7", f"zenoh:{far}").replace("DOMAIN_ID=7", f"DOMAIN_ID={far}")


@needs_cyclone_dds
def test_the_robot_is_used_from_the_other_network(run, other_domain):
    start, use, _ = blocks_of(with_domains(other_domain), "sh")
    environment = {"PATH": PATH, "RMW_IMPLEMENTATION": ""}
    node, relay = (
        run("bash", "-c", f"exec {line.removesuffix(' &')}", environment=environment)
        for line in start.splitlines()
    )
    relay.wait_for(r"/turtlesim/get_parameters ->")
    user = run("bash", "-ec", use, environment=environment)
    assert user.wait() == 0, user.text
    (shown,) = blocks_of(RELAY, "text")
    assert user.text.endswith(shown.strip())
    assert "Goal finished with status: SUCCEEDED" in user.text
    assert "response:\nturtlesim.srv.Spawn_Response(name='bob')" in user.text
    assert "Traceback" not in node.text + relay.text


def test_the_page_names_every_option(run):
    program = run("turtlewire", "relay", "--help", environment={"PATH": PATH})
    assert program.wait() == 0
    options = set(re.findall(r"--[a-z][a-z-]*", program.text)) - {"--help"}
    assert set(re.findall(r"`(--[a-z][a-z-]*)", RELAY)) == options
