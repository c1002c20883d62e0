"""`ros2 extensions`, `ros2 extension_points` and `ros2 doctor hello`; what other packages add."""

import re
import socket
import textwrap
import time

import pytest
from tests.programs import ROS2

import rclpy
from ros2cli.entry_points import declared
from ros2cli.main import main
from ros2doctor.verb.hello import (
    HelloMulticastUDPReceiver,
    HelloMulticastUDPSender,
    HelloPublisher,
    HelloSubscriber,
    SummaryTable,
)


def test_every_command_and_verb_is_listed(capsys):
    assert main(["extensions"]) == 0
    listed = capsys.readouterr().out
    for command in declared("ros2cli.command"):
        assert f"\n  {command}: " in listed
    assert "ros2doctor.verb\n  hello: " in listed
    assert main(["extensions", "-v"]) == 0
    assert "    module: ros2topic.verb.echo\n" in capsys.readouterr().out


def test_every_extension_point_is_listed(capsys):
    assert main(["extension_points"]) == 0
    points = capsys.readouterr().out.splitlines()
    assert main(["extensions"]) == 0
    titles = [line for line in capsys.readouterr().out.splitlines() if line[0] != " "]
    assert [point.partition(":")[0] for point in points] == titles


def test_the_table_counts_other_hosts(capsys):
    table = SummaryTable()
    table.increment_send()
    table.increment_send()
    table.increment_pub()
    table.increment_sub("mars")
    table.increment_receive("moon")
    table.increment_receive("moon")
    table.format_print_summary("/canyouhearme", 1.0)
    shown = capsys.readouterr().out
    assert shown.startswith(
        "Greetings in 1.0 s: 1 published, 2 sent\nTopic /canyouhearme: heard 1 other hosts\n"
    )
    assert re.search(r"mars +1\n", shown)
    assert "\nGroup 225.0.0.1:49150: heard 1 other hosts\n" in shown
    assert re.search(r"moon +2\n", shown)
    table.reset()
    table.format_print_summary("/canyouhearme", 1.0)
    assert "heard 0 other hosts" in capsys.readouterr().out


def test_greetings_of_other_hosts_are_counted(monkeypatch, capsys):
    ours, theirs = SummaryTable(), SummaryTable()
    with rclpy.init():
        node = rclpy.create_node("hello")
        monkeypatch.setattr("socket.gethostname", lambda: "mars")
        publisher = HelloPublisher(node, "hear_me", theirs)
        monkeypatch.undo()
        subscription = HelloSubscriber(node, "hear_me", ours)
        end = time.monotonic() + 60
        shown = ""
        while "mars" not in shown and time.monotonic() < end:
            publisher.publish()
            rclpy.spin_once(node, timeout_sec=0.1)
            ours.format_print_summary("hear_me", 1)
            shown = capsys.readouterr().out
        assert "Topic hear_me: heard 1 other hosts\n    mars" in shown
        publisher.destroy()
        subscription.destroy()


def test_datagrams_of_other_hosts_are_counted(monkeypatch, capsys):
    table = SummaryTable()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    receiver = HelloMulticastUDPReceiver(table, port=port, timeout=60)
    sender = HelloMulticastUDPSender(table, port=port, ttl=1)
    sender.send()
    receiver.recv()  # our own
    with monkeypatch.context() as moved:
        moved.setattr("socket.gethostname", lambda: "mars")
        sender.send()
    receiver.recv()
    receiver.shutdown()
    sender.shutdown()
    table.format_print_summary("/x", 1, port=port)
    shown = capsys.readouterr().out
    assert "Greetings in 1 s: 0 published, 2 sent\nTopic /x: heard 0 other hosts\n" in shown
    assert re.search(rf"Group 225.0.0.1:{port}: heard 1 other hosts\n    mars +1\n", shown)


def test_hello_ends_after_a_table(run):
    verb = run(*ROS2, "doctor", "hello", "--once", "-pp", "0.2")
    verb.wait()
    assert verb.process.returncode == 0 or "Network is unreachable" in verb.text, verb.text


def test_unknown_options_show_the_usage_of_the_verb(capsys):
    with pytest.raises(SystemExit) as end:
        main(["topic", "list", "--nope"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    assert told.startswith("usage: ros2 topic list [-h]")
    assert "ros2 topic list: error: unrecognized arguments: --nope" in told


# Commands, verbs and options that other packages add by entry points, as ROS 2's do.

ENTRY_POINTS = """
[ros2cli.command]
greet = greeting.command:GreetCommand
broken = greeting.missing:BrokenCommand

[ros2cli.extension_point]
ros2greet.verb = greeting.verbs:GreetingExtension
ros2lost.verb = greeting.missing:LostExtension
ros2topic.verb = greeting.missing:TopicExtension

[ros2greet.verb]
world = greeting.verbs:WorldVerb

[ros2topic.verb]
shout = greeting.verbs:ShoutVerb
list = greeting.missing:ListVerb

[ros2launch.option]
say = greeting.option:SayOption
"""

COMMAND = '''
from ros2cli.command import CommandExtension, add_subparsers_on_demand


class GreetCommand(CommandExtension):
    """Greet others."""

    def add_arguments(self, parser, cli_name):
        self._subparser = parser
        add_subparsers_on_demand(parser, cli_name, "_verb", "ros2greet.verb", required=False)

    def main(self, *, parser, args):
        if not hasattr(args, "_verb"):
            self._subparser.print_help()
            return 0
        return args._verb.main(args=args)
'''

VERBS = '''
from ros2cli.node.strategy import NodeStrategy, add_arguments
from ros2cli.verb import VerbExtension
from ros2topic.api import get_topic_names_and_types
from ros2topic.verb import VerbExtension as TopicVerbExtension


class GreetingExtension:
    """The extension point for 'greet' verb extensions."""


class WorldVerb(VerbExtension):
    """Greet the world."""

    def add_arguments(self, parser, cli_name):
        parser.add_argument("--loud", action="store_true")

    def main(self, *, args):
        print("HELLO" if args.loud else "hello")
        return 3


class ShoutVerb(TopicVerbExtension):
    """Shout the names of the topics."""

    def add_arguments(self, parser, cli_name):
        add_arguments(parser)
        parser.add_argument("wanted", nargs="?")

    def main(self, *, args):
        with NodeStrategy(args) as node:
            names = [name for name, _ in get_topic_names_and_types(node=node)]
        if args.wanted and args.wanted not in names:
            return f"no topic '{args.wanted}'"
        print(*(name.upper() for name in names))
'''

OPTION = """
from launch import LaunchDescription
from launch.actions import LogInfo
from ros2launch.option import OptionExtension


class SayOption(OptionExtension):
    def add_arguments(self, parser, cli_name, *, argv=None):
        parser.add_argument("--say", default="")

    def prelaunch(self, launch_description, args):
        return (LaunchDescription([LogInfo(msg=f"said {args.say}"), launch_description]),)

    def postlaunch(self, launch_return_code, args):
        print("ended", launch_return_code)
"""


@pytest.fixture
def ros2(run, tmp_path):
    package = tmp_path / "greeting"
    package.mkdir()
    for name, text in {
        "__init__": "",
        "command": COMMAND,
        "verbs": VERBS,
        "option": OPTION,
    }.items():
        (package / f"{name}.py").write_text(textwrap.dedent(text))
    metadata = tmp_path / "greeting-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: greeting\nVersion: 1.0\n")
    (metadata / "entry_points.txt").write_text(ENTRY_POINTS)
    environment = {"PYTHONPATH": str(tmp_path), "COLUMNS": "200"}

    def start(*words):
        program = run(*ROS2, *words, environment=environment)
        return program.wait(), f"{program.text}\n"

    return start


def test_a_command_is_in_the_help_and_runs(ros2):
    status, shown = ros2("--help")
    assert status == 0
    assert "    greet               Greet others\n" in shown
    assert "Failed to load entry point 'broken': ModuleNotFoundError: No module named" in shown
    status, shown = ros2("greet")
    assert status == 0
    assert "    world               Greet the world\n" in shown
    assert ros2("greet", "world", "--loud") == (3, "HELLO\n")
    status, shown = ros2("greet", "wurld")
    assert status == 2
    assert "invalid choice: 'wurld'" in shown


def test_a_broken_command_is_one_line_and_no_choice(ros2):
    status, shown = ros2("broken")
    assert status == 2
    assert shown.startswith("Failed to load entry point 'broken': ModuleNotFoundError")
    assert "Traceback" not in shown
    assert "invalid choice: 'broken'" in shown


def test_a_verb_is_added_and_none_is_replaced(ros2):
    assert "    shout               Shout the names of the topics\n" in ros2("topic", "-h")[1]
    assert ros2("topic", "shout") == (0, "/PARAMETER_EVENTS /ROSOUT\n")
    assert ros2("topic", "shout", "/none") == (1, "no topic '/none'\n")
    assert ros2("topic", "list") == (0, "/parameter_events\n/rosout\n")


def test_extensions_are_listed(ros2):
    status, shown = ros2("extensions", "-v")
    assert status == 0
    assert "  greet: Greet others\n    module: greeting.command\n" in shown
    assert "  shout: Shout the names of the topics\n    module: greeting.verbs\n" in shown
    assert "  list: List the topics\n    module: ros2topic.verb.list\n" in shown


def test_extension_points_are_listed(ros2):
    point = "ros2greet.verb: The extension point for 'greet' verb extensions\n"
    for option in ((), ("--all",)):
        status, shown = ros2("extension_points", *option)
        assert status == 0
        assert point in shown
        assert "Failed to load entry point 'ros2lost.verb': ModuleNotFoundError" in shown
        assert shown.count("ros2topic.verb") == 1
        shown = ros2("extensions", *option)[1]
        assert "ros2greet.verb\n  world: Greet the world\n" in shown
    assert f"{point}  module: greeting.verbs\n" in ros2("extension_points", "-v")[1]


def test_an_option_of_launch(ros2, tmp_path):
    file = tmp_path / "nothing.launch.xml"
    file.write_text("<launch/>")
    assert "--say SAY" in ros2("launch", "-h")[1]
    status, shown = ros2("launch", "--say", "hello", str(file))
    assert status == 0
    assert "said hello" in shown
    assert shown.endswith("ended 0\n")
