"""The ros2 command itself."""

import importlib
import os
import signal
import subprocess
import sys
import threading

import pytest
from tests.programs import ROS2, ROS2_IN_SHELL, run_python

from ros2cli import main as ros2cli_main
from ros2cli.entry_points import declared, first_line, summary
from ros2cli.main import main, make_parser
from turtlewire import msg
from turtlewire.wire import open_context
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import QoS


def test_every_command_and_verb_can_be_loaded(capsys):
    for command in declared("ros2cli.command"):
        with pytest.raises(SystemExit) as end:
            main([command, "--help"])
        assert end.value.code == 0
        text = capsys.readouterr().out
        parser = make_parser([command])
        assert f"ros2 {command}" in text
        choices = next(action for action in parser._actions if action.choices)
        verbs = next(
            (
                action.choices
                for action in choices.choices[command]._actions
                if action.choices and action.nargs == "A..."
            ),
            {},
        )
        for verb in verbs:
            with pytest.raises(SystemExit) as end:
                main([command, verb, "--help"])
            assert end.value.code == 0
            assert f"ros2 {command} {verb}" in capsys.readouterr().out


def test_without_a_command_the_help_is_shown(capsys):
    assert main([]) == 0
    assert "Commands:" in capsys.readouterr().out
    assert main(["topic"]) == 0
    assert "Verbs:" in capsys.readouterr().out


def test_an_unknown_verb_is_refused(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "nope"])
    assert end.value.code == 2
    assert "invalid choice: 'nope'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("raised", "status", "told"),
    [
        (KeyboardInterrupt(), 2, ""),
        (RuntimeError("no such thing"), 1, "no such thing\n"),
        (KeyError("x"), 1, "KeyError: 'x'\n"),
    ],
)
def test_verb_errors_become_one_line_and_a_status(monkeypatch, capsys, raised, status, told):
    import ros2pkg.verb.list as verb

    def fail(_args):
        raise raised

    monkeypatch.setattr(verb, "main", fail)
    assert main(["pkg", "list"]) == status
    assert capsys.readouterr().err == told


def test_the_hint_of_an_error_is_shown(monkeypatch, capsys):
    import ros2pkg.verb.list as verb
    from turtlewire.errors import WireError

    def fail(_args):
        raise WireError("cannot join").with_hint("Do this instead.")

    monkeypatch.setattr(verb, "main", fail)
    assert main(["pkg", "list"]) == 1
    assert capsys.readouterr().err.startswith("cannot join\nDo this instead.")


@pytest.mark.parametrize("words", [["--help"], ["topic", "list", "--help"], ["pkg", "list"]])
def test_light_commands_load_nothing_heavy(words):
    program = f"""
import sys
from ros2cli.main import main
try:
    main({words!r})
except SystemExit:
    pass
heavy = {{"numpy", "asyncio", "rclpy", "rich", "yaml", "launch", "turtlewire.msg"}}
print("loaded:", sorted(heavy & set(sys.modules)))
"""
    result = run_python(program)
    assert result.stdout.splitlines()[-1] == "loaded: []"


def test_the_graph_verbs_need_no_rclpy():
    program = """
import sys
from ros2cli.main import main
status = main(["topic", "list"])
print("status", status, sorted({"numpy", "asyncio", "rclpy", "turtlewire.msg"} & set(sys.modules)))
"""
    result = run_python(program)
    assert result.stdout.splitlines() == ["/parameter_events", "/rosout", "status 0 []"]


@pytest.mark.parametrize(
    ("words", "first_line"),
    [
        ("interface list", "Messages:\n"),
        ("interface show sensor_msgs/msg/Imu", "std_msgs/Header header\n"),
    ],
)
def test_a_reader_that_ends_early_is_no_error(words, first_line):
    command = f"{ROS2_IN_SHELL} {words} | head -1"
    result = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert (result.stdout, result.stderr) == (first_line, "")


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize(
    "words",
    [
        "topic hz /x",
        "topic bw /x",
        "topic delay /x",
        "topic pub --once /x std_msgs/msg/String",
        "topic pub --rate 1 /x std_msgs/msg/String",
        "topic pub --once -w 0 --keep-alive 600 /x std_msgs/msg/String",
        "service call /x std_srvs/srv/Empty",
        "service echo /x std_srvs/srv/Empty",
        "action send_goal /x example_interfaces/action/Fibonacci {}",
        "multicast receive",
        "doctor hello -pp 0.1",
    ],
)
def test_a_waiting_verb_ends_with_status_2_at_every_signal(run, words, end):
    verb = run(*ROS2, *words.split())
    verb.wait_for(
        "does not appear to be published yet|[Ww]aiting for|publishing #1|No publishers|Greetings"
    )
    verb.process.send_signal(end)
    assert verb.wait() == 2, verb.text
    assert "Traceback" not in verb.text
    assert "making request" not in verb.text


@pytest.mark.parametrize("closed", ["<&-", ">&-"])
@pytest.mark.parametrize("words", ["pkg list", "launch turtlesim multisim.launch.py --show-args"])
def test_closed_streams_are_no_error(words, closed):
    command = f"{ROS2_IN_SHELL} {words} {closed}"
    result = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert result.stderr == ""


def test_words_of_a_completion_are_taken_from_the_shell(monkeypatch):
    monkeypatch.setenv("_ARGCOMPLETE", "1")
    monkeypatch.setenv("COMP_LINE", "ros2 topic ec")
    assert ros2cli_main._words_to_complete() == ["topic", "ec"]


@pytest.mark.parametrize(
    "where", ["ros2cli.main.make_parser", "turtlewire_ros.guard.foreign_package"]
)
def test_an_early_interrupt_leaves_no_traceback(monkeypatch, where):
    from turtlewire_ros import guard

    def interrupt(*_arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr(where, interrupt)
    monkeypatch.setattr(sys, "argv", ["ros2", "topic", "list"])
    before = signal.getsignal(signal.SIGINT)
    assert guard.main() == 2
    # At its end, the command leaves the signal to the system; other tests send it to themselves.
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize(("verb", "lines"), [("echo", 2), ("hz", 1), ("bw", 2)])
def test_a_reader_of_messages_that_ends_early_is_no_error(verb, lines):
    context = open_context()
    try:
        kind = TypeId("std_msgs/msg/String", msg.type_hash("std_msgs/msg/String"))
        publisher = context.create_node("talker").create_publisher("/chatter", kind, QoS())
        end = threading.Event()
        message = msg.serialize(msg.get_message("std_msgs/msg/String")(data="hello"))

        def talk():
            while not end.wait(0.02):
                publisher.publish(message)

        talker = threading.Thread(target=talk)
        talker.start()
        command = f"{ROS2_IN_SHELL} topic {verb} /chatter | head -{lines}"
        try:
            result = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
        finally:
            end.set()
            talker.join()
    finally:
        context.close()
    assert len(result.stdout.splitlines()) == lines
    assert result.stderr == ""


def test_the_command_line_of_every_verb_is_data():
    groups = list(declared("ros2cli.extension_point"))
    entries = [entry for group in groups for entry in declared(group).values()]
    modules = [importlib.import_module(entry.module) for entry in entries]
    assert len(modules) > 50
    assert [module.__name__ for module in modules if hasattr(module, "add_arguments")] == []


def test_the_help_shows_the_first_line_of_each_class():
    for group in declared("ros2cli.extension_point"):
        for entry in declared(group).values():
            assert summary(entry) == first_line(entry.load()) != "", entry.value


def test_help_of_another_command_loads_no_verb():
    program = """
import sys
from ros2cli.main import main
try:
    main(["topic", "--help"])
except SystemExit:
    pass
print(sorted(name for name in sys.modules if name.startswith("ros2") and ".verb." in name))
"""
    result = run_python(program)
    assert result.stdout.splitlines()[-1] == "[]"


# The warning of a command whose node can discover nothing.

WARNING = """\
Warning: ROS_AUTOMATIC_DISCOVERY_RANGE=OFF with no ROS_STATIC_PEERS configured.
No discovery mechanism is available. Results will be empty.
Either:
  - Set ROS_STATIC_PEERS to specify peers explicitly, or
  - Change ROS_AUTOMATIC_DISCOVERY_RANGE to LOCALHOST or SUBNET
"""


def said(words, **variables):
    command = [*ROS2, *words.split()]
    environment = {**os.environ, **variables}
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, timeout=120, check=False
    )
    return done.stderr


@pytest.mark.parametrize("words", ["topic list", "node list", "param list"])
def test_a_node_that_discovers_nothing_warns_once(words):
    assert said(words, ROS_AUTOMATIC_DISCOVERY_RANGE="OFF") == WARNING


def test_other_configurations_have_no_warning():
    assert said("topic list", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST") == ""
    peers = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF", "ROS_STATIC_PEERS": "127.0.0.1"}
    assert said("topic list", **peers) == ""
    assert said("pkg prefix rclpy", ROS_AUTOMATIC_DISCOVERY_RANGE="OFF") == ""
