"""The functions and classes with which programs run verbs, and those inside of ros2cli."""

import argparse
import importlib.metadata
import io
import os
import signal
import socket
import sys
import threading
from types import SimpleNamespace

import pytest
from tests.programs import lines_in

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, QoSReliabilityPolicy
from ros2action.verb.send_goal import send_goal
from ros2bag.verb.play import positive_float
from ros2cli.command import MutableString, SuppressUsageOutput
from ros2cli.command.extension_points import EXTENSION_POINT_GROUP_NAME, ExtensionPointsCommand
from ros2cli.command.extensions import ExtensionsCommand
from ros2cli.daemon.daemonize import PicklerForProcess
from ros2cli.node.direct import DirectNode
from ros2interface.verb.show import (
    ACTION_REQUEST_RESPONSE_SEPARATOR,
    SERVICE_REQUEST_RESPONSE_SEPARATOR,
    InterfaceTextLine,
)
from ros2launch.command.launch import SuppressCompleterWorkaround
from ros2run.command.run import REMAINDER
from ros2topic.command.topic import TopicCommand
from ros2topic.verb import VerbExtension
from ros2topic.verb.echo import EchoVerb
from std_msgs.msg import String


@pytest.fixture
def node(monkeypatch):
    """A node of a program that runs verbs, in the default context."""
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    rclpy.init(args=[])
    node = rclpy.create_node("program")
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


PUBLISHER = """
import rclpy
from rclpy.qos import QoSProfile
from ros2topic.verb.pub import publisher
from std_msgs.msg import String

rclpy.init(args=[])
node = rclpy.create_node("program")
heard = []
node.create_subscription(String, "t", lambda message: heard.append(message.data), 10)
wait = 1, 60.0, QoSProfile(depth=10), 0.05
"""


@pytest.mark.parametrize(
    ("distro", "file"), [("jazzy", ""), ("kilted", "None, "), ("lyrical", "None, ")]
)
def test_publisher(distro, file):
    program = f"""
print(publisher(node, "std_msgs/msg/String", "t", "data: hi", {file}0.01, 2, 3, *wait))
print(heard)
print(publisher(node, "std_msgs/msg/String", "t", "nothing: 1", {file}0.01, 1, 1, *wait))
"""
    said = lines_in(distro, PUBLISHER + program)
    assert said[0] == "publisher: beginning loop"
    assert [line for line in said if line.startswith("publishing")] == [
        "publishing #2: std_msgs.msg.String(data='hi')"
    ]
    assert "None" in said
    assert "['hi', 'hi', 'hi']" in said
    assert any(line.startswith("Failed to populate field: ") for line in said)


def test_publisher_of_a_file(tmp_path):
    file = tmp_path / "messages.yaml"
    file.write_text("data: a\n---\ndata: b\n")
    program = f"""
publisher(node, "std_msgs/msg/String", "t", "", {str(file)!r}, 0.01, 1, 0, *wait)
print(heard)
"""
    assert "['a', 'b']" in lines_in("lyrical", PUBLISHER + program)


def test_subscribe_and_spin(node, capsys):
    publisher = node.create_publisher(String, "/t", 10)
    sent = []

    def tick():
        publisher.publish(String(data="hello"))
        sent.append(1)
        if len(sent) == 3:
            os.kill(os.getpid(), signal.SIGINT)

    node.create_timer(0.01, tick)
    with pytest.raises(KeyboardInterrupt):
        EchoVerb().subscribe_and_spin(node, "t", String, QoSProfile(depth=10), True, False)
    said = capsys.readouterr().out
    assert said.startswith("data: hello\n---\n")
    # The node is the caller's, and only the subscription is gone.
    assert [each.topic for each in node.subscriptions if each.topic == "/t"] == []


class OwnEcho(EchoVerb):
    """A verb of another package, with the command line and function of a built-in one."""


class OwnTopic(TopicCommand):
    """A command of another package with the verbs of a built-in one."""


class Plain(VerbExtension):
    """Has nothing of its own."""


def test_verbs_and_commands_of_others_have_what_they_inherit():
    for made in (OwnEcho(), EchoVerb()):
        parser = argparse.ArgumentParser()
        made.add_arguments(parser, "ros2 topic echo")
        assert "--no-arr" in parser.format_usage()
    parser = argparse.ArgumentParser()
    OwnTopic().add_arguments(parser, "ros2 topic", argv=["echo"])
    assert parser.parse_args(["echo", "/t"]).topic_name == "/t"


def test_a_verb_does_not_run_its_module_by_itself(monkeypatch):
    here = sys.modules[__name__]
    monkeypatch.setattr(here, "ARGUMENTS", ["--foo"], raising=False)
    monkeypatch.setattr(here, "main", print, raising=False)
    Plain().add_arguments(argparse.ArgumentParser(), "ros2 topic plain")
    with pytest.raises(NotImplementedError):
        Plain().main(args=None)


def test_choose_qos(node):
    profile = QoSProfile(depth=1, reliability=QoSReliabilityPolicy.BEST_EFFORT)
    node.create_publisher(String, "/t", profile)
    verb, parser = EchoVerb(), argparse.ArgumentParser()
    verb.add_arguments(parser, "ros2 topic echo")
    chosen = verb.choose_qos(node, parser.parse_args(["t"]))
    assert chosen.reliability == QoSReliabilityPolicy.BEST_EFFORT
    chosen = verb.choose_qos(node, parser.parse_args(["t", "--qos-reliability", "reliable"]))
    assert chosen.reliability == QoSReliabilityPolicy.RELIABLE


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def action_server(monkeypatch, request):
    monkeypatch.setenv("RMW_IMPLEMENTATION", request.param)

    def execute(goal):
        for number in range(8):
            goal.publish_feedback(Fibonacci.Feedback(sequence=[number]))
        goal.succeed()
        return Fibonacci.Result(sequence=[goal.request.order])

    context = rclpy.Context()
    context.init(args=[])
    server_node = rclpy.create_node("server", context=context)
    server = ActionServer(server_node, Fibonacci, "/fibonacci", execute)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(server_node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield server
    executor.shutdown()
    thread.join()
    context.try_shutdown()


@pytest.mark.usefixtures("action_server")
def test_send_goal(capsys):
    heard = []
    kind = "example_interfaces/action/Fibonacci"
    assert send_goal("fibonacci", kind, "order: 5", heard.append, 60) is None
    said = capsys.readouterr().out
    assert "Goal finished with status: SUCCEEDED" in said
    assert "sequence:\n- 5" in said
    assert [list(message.feedback.sequence) for message in heard] == [[n] for n in range(8)]
    assert send_goal("fibonacci", kind, "nothing: 5", None).startswith("Failed to populate")
    with pytest.raises(RuntimeError, match="The passed action type is invalid"):
        send_goal("fibonacci", "example_interfaces/action/Nothing", "{}", None)


def test_received_messages_are_handled_without_a_wait(node):
    heard = []
    node.create_subscription(String, "t", lambda message: heard.append(message.data), 10)
    publisher = node.create_publisher(String, "t", 10)
    for word in ("one", "two", "three"):
        publisher.publish(String(data=word))
    DirectNode.around(node).handle_received()
    assert heard == ["one", "two", "three"]
    DirectNode.around(node).handle_received()
    assert len(heard) == 3


def test_send_goal_without_a_server(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    told = send_goal("fibonacci", "example_interfaces/action/Fibonacci", "{}", None, 0)
    assert told == "No server of the action '/fibonacci' came within 0 s"


def test_text_that_changes_in_a_parser():
    text = MutableString()
    # As ros2cli's parsers in ROS 2; the other formatter wants a str.
    kind = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=text, formatter_class=kind)
    assert not text.strip()
    text.value = "What it does"
    assert "What it does" in parser.format_help()
    assert (list(text)[:2], text.upper(), str(text)) == (["W", "h"], "WHAT IT DOES", text.value)


def test_parsers_are_silent_within_a_block(capsys):
    parser = argparse.ArgumentParser()
    parser.add_argument("--number", type=int, required=True)
    with SuppressUsageOutput([parser]):
        parser.parse_known_args(["--help"])
        parser.exit(3, "text")
    assert capsys.readouterr() == ("", "")
    with pytest.raises(SystemExit):
        parser.parse_args(["--help"])
    assert "--number" in capsys.readouterr().out


def test_blocks_of_silent_parsers_nest(capsys):
    parser = argparse.ArgumentParser()
    parser.print_help = lambda: print("own")
    with SuppressUsageOutput([parser]):
        with SuppressUsageOutput([parser]):
            parser.print_help()
        parser.print_help()
    assert capsys.readouterr().out == ""
    parser.print_help()
    assert capsys.readouterr().out == "own\n"


def test_extensions_are_printed_one_by_one(capsys):
    entry = importlib.metadata.EntryPoint(
        "topic", "ros2topic.command.topic:TopicCommand", "ros2cli.command"
    )
    quiet, verbose = SimpleNamespace(verbose=False), SimpleNamespace(verbose=True)
    dist = SimpleNamespace(metadata={"Name": "ros2topic"}, version="1.2")
    (summary, *_) = entry.load().__doc__.splitlines()
    summary = summary.removesuffix(".")
    ExtensionsCommand().print_entry_point(quiet, dist, entry)
    ExtensionsCommand().print_entry_point(verbose, dist, entry)
    assert capsys.readouterr().out == (
        f"  topic: {summary}\n  topic: {summary}\n    module: ros2topic.command.topic\n"
        "    distribution: ros2topic 1.2\n"
    )
    ExtensionPointsCommand().print_extension_point(quiet, "ros2cli.command", entry)
    ExtensionPointsCommand().print_extension_point(verbose, "ros2cli.command", entry)
    assert capsys.readouterr().out == (
        f"ros2cli.command: {summary}\nros2cli.command: {summary}\n"
        "  module: ros2topic.command.topic\n"
    )
    assert EXTENSION_POINT_GROUP_NAME == "ros2cli.extension_point"


def test_separators_and_the_rest_of_a_command_line():
    for line in (SERVICE_REQUEST_RESPONSE_SEPARATOR, ACTION_REQUEST_RESPONSE_SEPARATOR):
        assert InterfaceTextLine("a", "B", f"{line} Header x").nested_type is None
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs=REMAINDER)
    assert parser.parse_args(["a", "--b"]).words == ["a", "--b"]


@pytest.mark.parametrize("text", ["0", "-1", "nan", "inf", "fast"])
def test_rates_of_bags_are_above_zero(text):
    assert positive_float(arg="0.5") == 0.5
    with pytest.raises(argparse.ArgumentTypeError):
        positive_float(text)


@pytest.mark.parametrize(("distro", "name"), [("jazzy", "topic"), ("kilted", "topics")])
def test_the_topic_of_print_hz(distro, name):
    program = f"""
from types import SimpleNamespace
from ros2topic.verb.hz import ROSTopicHz
clock = SimpleNamespace(now=lambda: None)
hz = ROSTopicHz(SimpleNamespace(get_clock=lambda: clock), 10, use_wtime=True)
for _ in range(3):
    hz.callback_hz(None, topic="/t")
hz.print_hz({name}="/t")
"""
    assert lines_in(distro, program)[0].startswith("average rate: ")


def test_a_completer_without_completions():
    completer = SuppressCompleterWorkaround()
    assert list(completer("l", parser=None)) == []
    assert completer.suppress() is True


@pytest.mark.skipif(sys.platform == "win32", reason="sockets are shared otherwise")
def test_a_pickler_names_the_sockets_of_its_last_object():
    pickler = PicklerForProcess(None, io.BytesIO())
    with socket.socket() as first, socket.socket() as second:
        pickler.dump([first, second])
        assert pickler.descriptors == [first.fileno(), second.fileno()]
        pickler.dump({"event": threading.Event(), "socket": second})
        assert pickler.descriptors == [second.fileno()]


def test_functions_of_the_daemon_keep_their_names():
    from ros2cli.daemon import bind, pretty_print_call

    bound = bind(pretty_print_call, print)
    assert (bound.__name__, bound.args) == ("pretty_print_call", (print,))
