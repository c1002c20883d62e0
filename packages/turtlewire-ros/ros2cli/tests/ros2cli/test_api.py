"""The functions and classes that programs import from the packages of `ros2`."""

import argparse
import io
import subprocess
import sys

import pytest
from tests.needs import HAS_CYCLONE_DDS

import rclpy
from ros2bag import api as bag
from ros2bag.verb.play import PlayVerb
from ros2cli import helpers, plugin_system
from ros2cli.entry_points import declared, get_entry_points, get_first_line_doc
from ros2cli.node.direct import DirectNode
from ros2cli.node.strategy import NodeStrategy
from ros2interface.verb.show import ReadStdinPipe
from ros2launch import api as launch
from ros2launch.api.api import get_launch_file_paths, parse_launch_arguments
from ros2pkg import api as pkg
from ros2run import api as run
from ros2topic.verb.list import ListVerb
from ros2topic.verb.pub import read_msg_from_yaml

GROUPS = [*declared("ros2cli.extension_point")]

PEER = """
import sys, threading
import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.lifecycle import LifecycleNode
from std_msgs.msg import String
from std_srvs.srv import Empty
rclpy.init()
node = LifecycleNode("peer", namespace="far")
node.declare_parameter("speed", 2.5, ParameterDescriptor(description="of what"))
node.create_subscription(String, "words", print, 10)
node.create_service(Empty, "reset", lambda _, answer: answer)
publisher = node.create_publisher(String, "/said", 10)
node.create_timer(0.02, lambda: publisher.publish(String(data="12345678")))
print("ready", flush=True)
threading.Thread(target=lambda: (sys.stdin.read(), rclpy.try_shutdown()), daemon=True).start()
try:
    rclpy.spin(node)
except rclpy.executors.ExternalShutdownException:
    pass
"""


@pytest.fixture
def peer():
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    process = subprocess.Popen([sys.executable, "-c", PEER], **pipes)
    assert process.stdout.readline() == b"ready\n"
    yield "/far/peer"
    process.communicate(timeout=60)


@pytest.fixture(params=[NodeStrategy, DirectNode])
def node(request, peer):
    with request.param(None) as node:
        yield node


def test_topics_services_and_nodes(node, peer):
    from ros2node import api as nodes
    from ros2service import api as services
    from ros2topic import api as topics
    from std_msgs.msg import String
    from std_srvs.srv import Empty

    assert nodes.wait_for_node(node, peer, timeout=60.0)
    said = nodes.TopicInfo("/said", ["std_msgs/msg/String"])
    where = {"node": node, "remote_node_name": peer}

    def is_known():
        """The graph may know a node before its endpoints, and an endpoint before its node."""
        return (
            said in nodes.get_publisher_info(**where)
            and nodes.get_subscriber_info(**where)
            and "/far/reset" in [each.name for each in nodes.get_service_server_info(**where)]
        )

    assert DirectNode.around(node).wait_for(is_known, timeout=60)
    assert ("/said", ["std_msgs/msg/String"]) in topics.get_topic_names_and_types(node=node)
    assert "/far/words" in topics.get_topic_names(node=node)
    assert topics.get_msg_class(node, "/said", blocking=True) is String
    assert "/far/reset" in services.get_service_names(node=node)
    assert services.get_service_class(node, "/far/reset", False) is Empty
    assert services.get_service_class(node, "/none", False) is None
    assert nodes.NodeName("peer", "/far", peer) in nodes.get_node_names(node=node)
    own = {each.name for each in nodes.get_node_names(node=node, include_hidden_nodes=True)}
    assert node.get_name() in own
    heard = [each.name for each in nodes.get_subscriber_info(**where)]
    assert heard == ["/far/words"]


def test_parameters_and_states(node, peer):
    from lifecycle_msgs.msg import Transition
    from rclpy.parameter import Parameter
    from ros2lifecycle import api as lifecycle
    from ros2param import api

    where = {"node": node, "node_name": peer}
    assert "speed" in api.call_list_parameters(**where).result.names
    (value,) = api.call_get_parameters(**where, parameter_names=["speed"]).values
    assert api.get_value(parameter_value=value) == 2.5
    assert api.get_parameter_type_string(value.type) == "double"
    assert api.get_parameter_value(string_value="2.5") == value
    new = [Parameter("speed", value=1.0).to_parameter_msg()]
    assert api.call_set_parameters(**where, parameters=new).results[0].successful
    (found,) = api.call_describe_parameters(**where, parameter_names=["speed"]).descriptors
    assert found.description == "of what"
    assert [each.full_name for each in lifecycle.get_node_names(node=node)] == [peer]
    states = lifecycle.call_get_states(node=node, node_names=[peer])
    assert states[peer].label == "unconfigured"
    configure = Transition(id=Transition.TRANSITION_CONFIGURE)
    assert lifecycle.call_change_states(node=node, transitions={peer: configure}) == {peer: True}
    possible = lifecycle.call_get_available_transitions(node=node, states={peer: None})[peer]
    assert "activate" in [each.transition.label for each in possible]


def test_completions(peer):
    """They take the command line of any extension, with no options of ours in it."""
    from ros2node.api import NodeNameCompleter
    from ros2param.api import ParameterNameCompleter
    from ros2topic.api import TopicMessagePrototypeCompleter, TopicNameCompleter, TopicTypeCompleter

    args = argparse.Namespace(node_name=peer, topic="/said", type="std_msgs/msg/Bool")
    assert peer in NodeNameCompleter()("", args)
    assert "speed" in ParameterNameCompleter()("", args)
    assert "/said" in TopicNameCompleter()("", args)
    assert TopicTypeCompleter(topic_name_key="topic")("", args) == ["std_msgs/msg/String"]
    assert TopicMessagePrototypeCompleter(topic_type_key="type")("", args) == ["{data: false}"]


def test_rate_and_bandwidth_of_a_topic(node, capsys):
    """As rqt_topic uses them: callbacks of a node that the program spins."""
    from ros2topic.verb.bw import ROSTopicBandwidth
    from ros2topic.verb.hz import ROSTopicHz
    from std_msgs.msg import String

    rate, bandwidth = ROSTopicHz(node, 10), ROSTopicBandwidth(node, 10)
    assert rate.get_hz("/said") is bandwidth.get_bw() is None
    node.create_subscription(String, "/said", lambda m: rate.callback_hz(m, "/said"), 10)
    node.create_subscription(String, "/said", bandwidth.callback, 10, raw=True)
    while len(rate.get_times("/said")) < 9 or bandwidth.get_bw() is None:
        rclpy.spin_once(node)
    per_ns, shortest, longest, _, count = rate.get_hz("/said")
    assert shortest * 0.99 <= 1 / per_ns <= longest * 1.01
    assert count == 9
    _, count, mean, least, most = bandwidth.get_bw()
    assert count > 1
    size = 20 if HAS_CYCLONE_DDS else 17  # DDS fills messages up to a multiple of four
    assert (mean, least, most) == (size, size, size)
    assert rate.get_hz("/said") is None, "nothing came since"
    rate.callback_hz(String(), "/said")
    rate.print_hz("/said")
    assert capsys.readouterr().out.endswith("window: 10\n")


@pytest.mark.parametrize("group", GROUPS)
def test_every_command_and_verb_has_its_class(group):
    """Each has ROS 2's base, its line in the help, and defines its command line."""
    entries = get_entry_points(group)
    for name, cls in ((name, entry.load()) for name, entry in entries.items()):
        assert cls.__name__ == f"{name.title().replace('_', '')}{group.split('.')[-1].title()}"
        extension = cls()
        assert get_first_line_doc(extension)
        parser = argparse.ArgumentParser()
        extension.add_arguments(parser, f"ros2 {name}")
        with pytest.raises(SystemExit):
            parser.parse_args(["--no-such-option-of-any-verb"])


def test_a_verb_runs_by_its_class(capsys, tmp_path):
    from ros2pkg.command.pkg import PkgCommand
    from ros2pkg.verb.prefix import PrefixVerb

    parser = argparse.ArgumentParser()
    PrefixVerb().add_arguments(parser, "ros2 pkg")
    assert (
        PrefixVerb()
        .main(args=parser.parse_args(["no_such_package"]))
        .startswith("Package not found")
    )
    parser = argparse.ArgumentParser()
    command = PkgCommand()
    command.add_arguments(parser, "ros2 pkg", argv=["executables", "turtlesim"])
    args = parser.parse_args(["executables", "turtlesim"])
    assert not command.main(parser=parser, args=args)
    assert "turtlesim turtlesim_node\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("version", "wanted", "fits"),
    [
        ("0.1", "^0.1", True),
        ("0.1.5", "^0.1", True),
        ("0.2", "^0.1", False),
        ("0.0", "^0.1", False),
        ("1.9", "^1.2", True),
        ("2.0", "^1.2", False),
    ],
)
def test_versions_of_extensions(version, wanted, fits):
    if fits:
        plugin_system.satisfies_version(version, wanted)
    else:
        with pytest.raises(plugin_system.PluginException, match=version):
            plugin_system.satisfies_version(version, wanted)


def test_helpers(capsys, monkeypatch):
    said = []
    hooked = helpers.before_invocation(str.upper, lambda func, word: said.append((func, word)))
    assert hooked("a") == "A"
    assert said == [(str.upper, "a")]
    helpers.pretty_print_call(test_helpers, 1, name="x")
    assert capsys.readouterr().out == "test_helpers(1, name='x')\n"
    monkeypatch.setenv("ROS_DOMAIN_ID", "7")
    assert helpers.get_ros_domain_id() == 7
    answers = iter([False, False, True])
    assert helpers.wait_for(lambda: next(answers), timeout=60, period=0.001)
    assert not helpers.wait_for(lambda: False, timeout=0)


def test_a_program_of_one_command(capsys):
    from ros2cli.cli import main
    from ros2interface.command.interface import InterfaceCommand

    assert not main(
        script_name="interfaces",
        argv=["proto", "std_msgs/msg/Bool", "--no-quotes"],
        extension=InterfaceCommand(),
    )
    assert capsys.readouterr().out == "data: false\n\n"
    assert main(argv=["pkg", "prefix", "no_such_package"]) == 1


def test_only_this_host_may_call():
    from ros2cli.xmlrpc.client import ServerProxy
    from ros2cli.xmlrpc.local_server import LocalXMLRPCServer

    with LocalXMLRPCServer(("127.0.0.1", 0), logRequests=False) as server:
        import threading

        server.register_function(lambda a, b: a + b, "add")
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        with ServerProxy(f"http://127.0.0.1:{server.server_address[1]}") as proxy:
            assert proxy.add(2, 3) == 5
        assert server.verify_request(None, ("127.0.0.1", 1))
        assert not server.verify_request(None, ("192.0.2.1", 1))
        server.shutdown()
        thread.join()


def test_qos_of_a_command_line():
    from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
    from ros2topic.api import add_qos_arguments, qos_profile_from_short_keys

    parser = argparse.ArgumentParser()
    add_qos_arguments(parser, "subscribe", "sensor_data")
    args = parser.parse_args(["--qos-durability", "transient_local", "--qos-depth", "3"])
    profile = qos_profile_from_short_keys(
        "sensor_data", durability=args.qos_durability, depth=args.qos_depth
    )
    assert profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    assert profile.reliability == ReliabilityPolicy.BEST_EFFORT
    assert profile.depth == 3


def test_values_of_bag(tmp_path):
    assert bag.check_positive_float("0.5") == 0.5
    assert bag.check_not_negative_int("0") == 0
    for check, text in (
        (bag.check_positive_float, "0"),
        (bag.check_not_negative_float, "-1"),
        (bag.check_not_negative_int, "1.5"),
        (bag.check_path_exists, str(tmp_path / "none")),
    ):
        with pytest.raises(argparse.ArgumentTypeError):
            check(text)
    assert bag.convert_service_to_service_event_topic(["/a"]) == ["/a/_service_event"]
    assert bag.dict_to_duration({"sec": 1, "nsec": 5}).nanoseconds == 1_000_000_005
    with pytest.raises(ValueError, match="both seconds and nanoseconds"):
        bag.dict_to_duration({"sec": 1})
    profiles = bag.convert_yaml_to_qos_profile({"/tf": {"depth": 3}})
    assert profiles["/tf"].depth == 3
    with pytest.raises(ValueError, match="depht"):
        bag.interpret_dict_as_qos_profile({"depht": 3})
    assert bag.create_bag_directory(str(tmp_path / "new")) is None
    assert bag.create_bag_directory(str(tmp_path / "new")).startswith("[ERROR] [ros2bag]: ")


def test_executables(capfd):
    path = run.get_executable_path(package_name="urdfdom", executable_name="check_urdf")
    assert path in pkg.get_executable_paths(package_name="urdfdom")
    assert run.get_executable_path(package_name="urdfdom", executable_name="none") is None
    with pytest.raises(pkg.PackageNotFound):
        pkg.get_executable_paths(package_name="no_such_package")
    assert pkg.get_prefix_path("urdfdom") in path
    assert "urdfdom" in pkg.get_package_names()
    assert run.run_executable(path=path, argv=["no_such_file.urdf"]) != 0
    assert "[ros2run]: Process exited with failure" in capfd.readouterr().out


def test_launch_files(tmp_path, capsys):
    file = tmp_path / "some.launch.xml"
    file.write_text('<launch><arg name="speed" default="2" description="how fast"/></launch>')
    assert launch.is_launch_file(str(file))
    assert not launch.is_launch_file("some.urdf")
    assert get_launch_file_paths(path=str(tmp_path)) == [str(file)]
    assert parse_launch_arguments(["a:=1", "a:=2"]) == [("a", "2")]
    launch.print_arguments_of_launch_file(launch_file_path=str(file))
    assert "'speed':\n        how fast\n        (default: '2')" in capsys.readouterr().out
    with pytest.raises(FileNotFoundError, match="file 'none' was not found in the share"):
        launch.get_share_file_path_from_package(package_name="urdfdom", file_name="none")
    assert (
        launch.launch_a_launch_file(
            launch_file_path=str(file), launch_file_arguments=["speed:=3"], noninteractive=True
        )
        == 0
    )


def test_the_messages_in_a_file(tmp_path):
    path = tmp_path / "points.yaml"
    path.write_text("{x: 1}\n---\n---\n{x: 2}\n")
    assert list(read_msg_from_yaml(str(path))) == [{"x": 1}, {"x": 2}]
    with pytest.raises(RuntimeError, match=r"Cannot read .*: No such file"):
        list(read_msg_from_yaml(str(tmp_path / "none.yaml")))


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_an_argument_is_read_from_stdin(monkeypatch, capsys):
    parser = argparse.ArgumentParser()
    parser.add_argument("type", nargs="?", action=ReadStdinPipe)
    assert parser.parse_args([]).type is None
    assert parser.parse_args(["std_msgs/msg/String"]).type == "std_msgs/msg/String"
    monkeypatch.setattr("sys.stdin", io.StringIO("std_msgs/msg/Bool\nmore\n"))
    assert parser.parse_args(["-"]).type == "std_msgs/msg/Bool"
    for stdin, error in ((io.StringIO(), "value is empty"), (Terminal(), "expected stdin pipe")):
        monkeypatch.setattr("sys.stdin", stdin)
        with pytest.raises(SystemExit):
            parser.parse_args(["-"])
        assert error in capsys.readouterr().err


def test_topics_as_a_verbose_list():
    info = [("/a", ["x/msg/A"], 1, 0), ("/b", ["x/msg/A", "x/msg/B"], 2, 3)]
    assert ListVerb.show_topic_info(info, True) == (
        "Published topics:\n * /a [x/msg/A] 1 publisher\n * /b [x/msg/A, x/msg/B] 2 publishers\n"
    )
    assert ListVerb.show_topic_info(info, False) == (
        "Subscribed topics:\n * /b [x/msg/A, x/msg/B] 3 subscribers\n"
    )


def test_a_playback_ends_at_the_time_in_seconds_or_nanoseconds():
    until = PlayVerb().get_playback_until_from_arg_group
    assert until(1.5, -1) == 1_500_000_000
    assert until(-1.0, 7) == 7
    assert until(-1.0, -1) == -1
