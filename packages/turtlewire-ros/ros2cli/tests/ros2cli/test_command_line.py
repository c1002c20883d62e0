"""Words on the command line: read as values, completed, and chosen from a list in Lyrical."""

import argparse
import os
import subprocess
import sys

import pytest
import yaml
from tests.programs import ROS2, offered

from ros2cli.arguments import (
    assignment,
    positive_float,
    positive_int,
    read_values,
    regular_expression,
    shortened,
    unsigned_int,
)
from ros2cli.completion import interface_names, prototype
from ros2cli.suggestion import did_you_mean
from rosidl_runtime_py import set_message_fields
from rosidl_runtime_py.utilities import get_message
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def test_yaml_values():
    assert read_values("{x: 1.0, name: 'a'}") == {"x": 1.0, "name": "a"}
    assert read_values("") == {}
    with pytest.raises(
        RuntimeError, match=r"^The passed value needs to be a dictionary in YAML format$"
    ):
        read_values("hello")
    with pytest.raises(yaml.YAMLError):
        read_values("{x: 1")


@pytest.mark.parametrize(
    ("convert", "bad"),
    [(positive_float, "0"), (positive_float, "-1.5"), (positive_int, "0"), (unsigned_int, "-1")],
)
def test_numbers_out_of_range_are_refused(convert, bad):
    with pytest.raises(argparse.ArgumentTypeError):
        convert(bad)


def test_numbers():
    assert (positive_float("0.5"), positive_int("3"), unsigned_int("0")) == (0.5, 3, 0)
    with pytest.raises(ValueError, match="could not convert"):
        positive_float("abc")


def test_near_names_are_suggested():
    assert (
        did_you_mean("/turtel1/pose", ["/turtle1/pose", "/tf"]) == "\nDid you mean: /turtle1/pose"
    )
    assert did_you_mean("/zzz", ["/turtle1/pose"]) == ""


BOMB = "\n".join(
    ["a0: &a0 [lol, lol]", *(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 9))]
)


@pytest.mark.parametrize("text", [BOMB, "{data: &a [*a]}"])
def test_aliases_that_stand_for_too_much_are_refused(text):
    with pytest.raises(RuntimeError, match=r"^The aliases of the passed value .* too many values$"):
        read_values(text)


def test_aliases_of_ordinary_size_are_taken(monkeypatch):
    assert read_values("{a: &x [1, 2], b: *x}") == {"a": [1, 2], "b": [1, 2]}
    monkeypatch.setattr("ros2cli.arguments._MOST_COPIES", 100)
    assert len(read_values(f"{{data: [{'1, ' * 1_000}]}}")["data"]) == 1_000


@pytest.fixture
def _usual_depth():
    """Set the usual limit of recursion, which another test may have raised."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(1000)
    yield
    sys.setrecursionlimit(limit)


@pytest.mark.usefixtures("_usual_depth")
def test_deep_nesting_is_refused_in_one_line():
    with pytest.raises(RuntimeError, match=r"^The passed value is nested too deeply$"):
        read_values(f"{{data: {'[' * 1500}{']' * 1500}}}")


def test_a_date_of_no_calendar_is_refused_in_one_line():
    with pytest.raises(RuntimeError, match=r"what looks like a date: month must be in 1\.\.12"):
        read_values("{data: 2026-13-01}")


def test_errors_that_quote_a_value_are_cut():
    assert shortened(ValueError("short")) == "short"
    assert len(shortened(ValueError("x" * 10_000_000))) < 2000


def test_assignments():
    assert assignment("a:=b:=c") == ("a", "b:=c")
    for bad in ("a", ":=b"):
        with pytest.raises(argparse.ArgumentTypeError, match="not of the form name:=value"):
            assignment(bad)


def test_regular_expressions():
    assert regular_expression("^back.*_r$") == "^back.*_r$"
    with pytest.raises(
        argparse.ArgumentTypeError, match=r"^'\(' is not a regular expression: missing"
    ):
        regular_expression("(")


# Completions of the next word for a shell.


def offered_at_last(line):
    """Press TAB again while it offers nothing: under load, it gives up too soon."""
    return next((found for _ in range(20) if (found := offered(line))), set())


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 to", {"topic"}),
        ("ros2 topic e", {"echo"}),
        ("ros2 topic pub --qos-rel", {"--qos-reliability"}),
        ("ros2 interface show geometry_msgs/msg/TwistSt", {"geometry_msgs/msg/TwistStamped"}),
        ("ros2 topic echo --qos-reliability best_e", {"best_effort"}),
    ],
)
def test_words_that_are_known_without_nodes(line, expected):
    assert offered(line) == expected


def test_names_of_the_graph():
    context = open_context()
    try:
        node = context.create_node("some_node")
        node.create_publisher(
            "/some/topic", TypeId("std_msgs/msg/String", "RIHS01_" + "0" * 64), QoS()
        )
        assert offered_at_last("ros2 topic echo /some") == {"/some/topic"}
        assert offered_at_last("ros2 topic pub /some/topic ") >= {"std_msgs/msg/String"}
        assert offered_at_last("ros2 node info /so") == {"/some_node"}
    finally:
        context.close()


def test_names_of_parameters(run):
    program = (
        "import rclpy; rclpy.init(); node = rclpy.create_node('some_node'); "
        "node.declare_parameter('speed', 1.0); "
    )
    other = run(sys.executable, "-c", program + "print('ready', flush=True); rclpy.spin(node)")
    other.wait_for("ready")
    for verb in ("get", "set", "delete", "describe"):
        assert offered_at_last(f"ros2 param {verb} /some_node sp") == {"speed"}
    assert offered("ros2 param get /nobody sp") == set()


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2 topic pub /x geometry_msgs/msg/Vector3 '", "{x: 0.0, y: 0.0, z: 0.0}"),
        (
            "ros2 topic pub /x geometry_msgs/msg/Twist '",
            "{linear: {x: 0.0, y: 0.0, z: 0.0}, angular: {x: 0.0, y: 0.0, z: 0.0}}",
        ),
        ("ros2 service call /x std_srvs/srv/SetBool '", "{data: false}"),
        ("ros2 action send_goal /x turtlesim/action/RotateAbsolute '", "{theta: 0.0}"),
    ],
)
def test_prototypes_of_values(line, expected):
    assert expected in {word.lstrip("'").rstrip("'") for word in offered(line)}


def test_a_prototype_of_any_message_is_its_default_value():
    names = interface_names("msg")
    assert len(names) > 200
    for name in names:
        [text] = prototype("msg", name)
        message = get_message(name)()
        set_message_fields(message, yaml.safe_load(text))
        assert message == get_message(name)(), text


@pytest.mark.parametrize("line", ["ros2 topic pub /x no/such/Type '", "ros2 topic echo /x y z"])
def test_nothing_is_offered_where_nothing_fits(line, tmp_path, monkeypatch):
    (tmp_path / "some_file").touch()
    monkeypatch.chdir(tmp_path)
    assert {word for word in offered(line) if not word.startswith("-")} == set()


@pytest.mark.parametrize("line", ["ros2 param load /x so", "ros2 launch ./so"])
def test_files_are_offered_where_they_fit(line, tmp_path, monkeypatch):
    (tmp_path / "some_file.launch.py").touch()
    monkeypatch.chdir(tmp_path)
    assert {os.path.basename(word) for word in offered(line)} == {"some_file.launch.py"}


# Arguments that the user chooses from a list, in Lyrical.


#: Stands for fzf: says how it was called, and chooses the last text that contains a word.
FZF = """#!{python}
import os, sys
items = sys.stdin.read().split("\\n")
print("called", sys.argv[1:], len(items), file=sys.stderr)
chosen = [item for item in items if os.environ["CHOICE"] in item]
if chosen:
    print(chosen[-1])
sys.exit(0 if chosen else 130)
"""

NODE = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("chatter")
node.declare_parameter("speed", 3)
publisher = node.create_publisher(String, "/chat", 1)
timer = node.create_timer(0.1, lambda: publisher.publish(String(data="hello")))
print("ready", flush=True)
rclpy.spin(node)
"""

CALLED = "called ['--prompt', '{} ', '--height', '40%', '--reverse'] "


@pytest.fixture
def choose(run, tmp_path):
    """Runs a command in a terminal; the stand-in for fzf chooses what contains a word."""
    (tmp_path / "fzf").write_text(FZF.format(python=sys.executable))
    (tmp_path / "fzf").chmod(0o755)

    def start(words, choice):
        environment = {
            "ROS_DISTRO": "lyrical",
            "PATH": f"{tmp_path}:{os.environ['PATH']}",
            "CHOICE": choice,
        }
        command = (*ROS2, *words.split())
        return run(*command, environment=environment, terminal=True)

    return start


@pytest.fixture
def node(run):
    run(sys.executable, "-c", NODE).wait_for("ready")


def without_terminal(words, distro="lyrical"):
    done = subprocess.run(
        [*ROS2, *words.split()],
        env={**os.environ, "ROS_DISTRO": distro},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    ("words", "choice", "prompt", "told"),
    [
        ("topic echo --once", "/chat", "Select topic to echo:", "data: hello\n---"),
        ("topic info", "/chat", "Select topic for info:", "Type: std_msgs/msg/String\nPub"),
        ("topic type", "/chat", "Select topic for type:", "std_msgs/msg/String"),
        ("node info", "/chatter", "Select node for info:", "/chatter\n  Subscribers:"),
        ("interface show", "srv/Trigger", "Select interface to show:", "---\nbool success"),
    ],
)
def test_verbs_use_the_chosen_name(node, choose, words, choice, prompt, told):
    verb = choose(words, choice)
    assert verb.wait() == 0
    assert verb.text.startswith(CALLED.format(prompt))
    assert told in verb.text


@pytest.mark.parametrize(("verb", "told"), [("hz", "average rate: "), ("bw", "KB/s|B/s from")])
def test_statistics_of_the_chosen_topic(node, choose, verb, told):
    running = choose(f"topic {verb}", "/chat")
    running.wait_for(told)
    running.process.terminate()
    running.wait()
    assert running.text.startswith(CALLED.format(f"Select topic for {verb}:"))


def test_a_program_and_a_parameter_are_chosen_in_two_steps(node, choose):
    verb = choose("param get", "e")  # the last node with this letter is /chatter
    assert verb.wait() == 0
    first, second, *told = verb.text.splitlines()
    assert first.startswith(CALLED.format("Select node:"))
    assert second.startswith(CALLED.format("Select parameter:"))
    assert told == ["Boolean value is: False"]
    verb = choose("run tf2_ros", "static_transform_publisher")
    assert verb.wait() == 1
    assert verb.text.startswith(CALLED.format("Select executable:"))
    verb = choose("run", "no such package")
    assert verb.wait() == 1
    called, told = verb.text.splitlines()
    assert called.startswith(CALLED.format("Select package:"))
    assert told == "No package selected"


def test_no_choice_ends_quietly(node, choose):
    for words in ("topic echo", "topic hz", "topic info", "topic type", "node info"):
        verb = choose(words, "no such name")
        assert verb.wait() == 0
        assert len(verb.text.splitlines()) == 1


TTY = "Error: Interactive selection requires a TTY terminal.\n"


@pytest.mark.parametrize(
    ("words", "status", "second"),
    [
        *[(f"topic {verb}", 0, "") for verb in ("echo", "hz", "bw", "info", "type")],
        ("node info", 0, ""),
        ("run", 1, "No package selected\n"),
        ("run tf2_ros", 1, "No executable selected\n"),
        ("interface show", 1, "No interface selected\n"),
        ("param get", 1, "No node selected\n"),
    ],
)
def test_without_a_terminal(node, words, status, second):
    assert without_terminal(words) == (status, "", TTY + second)
    # As before, these command lines are wrong.
    status, _, told = without_terminal(words, "kilted")
    assert status == 2
    assert "the following arguments are required: " in told


def test_without_nodes_there_is_nothing_to_choose():
    assert without_terminal("node info") == (0, "", "No nodes available to select from.\n")


def test_without_fzf(node, run, tmp_path):
    environment = {"ROS_DISTRO": "lyrical", "PATH": str(tmp_path)}
    words = (*ROS2, "topic", "echo")
    verb = run(*words, environment=environment, terminal=True)
    assert verb.wait() == 0
    assert verb.text.startswith("Error: fzf is not installed.")
