"""Arguments that the user chooses from a list, in Lyrical."""

import os
import subprocess
import sys

import pytest

ROS2 = "from ros2cli.main import main; import sys; sys.exit(main(sys.argv[1:]))"

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
        command = (sys.executable, "-c", ROS2, *words.split())
        return run(*command, environment=environment, terminal=True)

    return start


@pytest.fixture
def node(run):
    run(sys.executable, "-c", NODE).wait_for("ready")


def without_terminal(words, distro="lyrical"):
    done = subprocess.run(
        [sys.executable, "-c", ROS2, *words.split()],
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
    words = (sys.executable, "-c", ROS2, "topic", "echo")
    verb = run(*words, environment=environment, terminal=True)
    assert verb.wait() == 0
    assert verb.text.startswith("Error: fzf is not installed.")
