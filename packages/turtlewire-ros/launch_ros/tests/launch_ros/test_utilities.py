"""Parameters, remappings, names and extensions: what programs import besides actions."""

import importlib
import logging
import os
import threading
from pathlib import Path

import pytest

import rclpy
from launch import LaunchContext
from launch.actions import LogInfo
from launch.conditions import IfCondition
from launch.frontend import Parser
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros._node import extensions
from launch_ros.actions import (
    LifecycleTransition,
    Node,
    ROSTimer,
    SetParameter,
    SetROSLogDir,
    SetUseSimTime,
)
from launch_ros.actions.load_composable_nodes import get_composable_node_load_request
from launch_ros.actions.node import NodeActionExtension, get_extensions, instantiate_extension
from launch_ros.descriptions import ComposableNode
from launch_ros.events.lifecycle import ChangeState, matches_node_name
from launch_ros.parameter_descriptions import Parameter, ParameterFile
from launch_ros.ros_adapters import ROSAdapter
from launch_ros.utilities import (
    add_node_name,
    evaluate_parameters,
    get_node_name_count,
    make_namespace_absolute,
    normalize_parameters,
    normalize_remap_rule,
    normalize_remap_rules,
    prefix_namespace,
    to_parameters_list,
)
from launch_ros.utilities.plugin_support import (
    PluginException,
    get_upper_bound_caret_version,
    satisfies_version,
)
from launch_ros.utilities.to_parameters_list import is_node_name_matched
from lifecycle_msgs.msg import State, Transition
from rclpy.parameter import parameter_value_to_python


@pytest.fixture
def context():
    made = LaunchContext()
    made.launch_configurations["x"] = "3"
    return made


def test_namespaces():
    assert make_namespace_absolute("") == "/"
    assert [
        prefix_namespace(*pair) for pair in ((None, ""), ("a", ""), ("a", "b"), (None, None))
    ] == ["", "a", "a/b", None]


def test_node_names_are_counted(context):
    assert get_node_name_count(context, "/a") == 0
    assert [add_node_name(context, "/a"), add_node_name(context, "/a")] == [1, 2]
    assert get_node_name_count(context, "/a") == 2


def test_parameters(context, tmp_path):
    file = tmp_path / "file.yaml"
    file.write_text("/**:\n  ros__parameters: {x: $(var x)}\n")
    given = [
        {"a": {"b": LaunchConfiguration("x"), "text": "5"}, "list": ["p", "q"]},
        ParameterFile(str(file), allow_substs=True),
        Parameter("c", "1", value_type=str),
        {"empty": [TextSubstitution(text="")]},
    ]
    flat, path, one, empty = evaluate_parameters(context, normalize_parameters(given))
    assert flat == {"a.b": 3, "a.text": "5", "list": ["p", "q"]}
    assert path.read_text() == "/**:\n  ros__parameters: {x: 3}\n"
    assert (one.name, one.value, one.value_type) == ("c", "1", str)
    assert empty == {"empty": ""}
    assert Parameter("d", 4).value == 4
    messages = to_parameters_list(context, "n", "/ns", [flat, path, one, {"a.b": 7}])
    assert [(each.name, parameter_value_to_python(each.value)) for each in messages] == [
        ("a.b", 7),
        ("a.text", "5"),
        ("list", ["p", "q"]),
        ("x", 3),
        ("c", "1"),
    ]
    path.unlink()


def test_substitutions_in_a_file(context, tmp_path):
    (tmp_path / "file.yaml").write_text("{}")
    path = str(tmp_path / "file.yaml")
    assert ParameterFile(path).allow_substs is False
    asked = ParameterFile(path, allow_substs=LaunchConfiguration("no", default="false"))
    assert isinstance(asked.allow_substs, list)
    asked.evaluate(context)
    assert asked.allow_substs is False


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"parameters": [5]}, "Expecting a parameter file, a mapping of parameters or a Parameter"),
        ({"parameters": 5}, "Expecting a list of parameter files or parameter dictionaries"),
        ({"parameters": [{5: 1}]}, "is neither text nor a substitution"),
        ({"remappings": [("a", "b", "c")]}, "must be a tuple of length 2, but got length 3"),
        ({"remappings": ["ab"]}, "Expected 'remap_rule' to be of type"),
    ],
)
def test_wrong_parameters_and_remappings_are_reported(wrong, says):
    with pytest.raises(TypeError, match=says):
        Node(package="p", executable="e", **wrong)


def test_remappings(context):
    source, target = normalize_remap_rule(("a", ["b", LaunchConfiguration("x")]))
    assert [part.perform(context) for part in (*source, *target)] == ["a", "b", "3"]
    assert len(list(normalize_remap_rules([("a", "b"), ("c", "d")]))) == 2


def test_a_composable_node(context, tmp_path):
    flat = tmp_path / "flat.yaml"
    flat.write_text("z: {y: 1}\na: 2\n")
    node = ComposableNode(
        package="p",
        plugin="P",
        name="n",
        parameters=[{"b": 1, "a": 1}, str(flat)],
        remappings=[("f", "t")],
        extra_arguments=[{"use_intra_process_comms": True}],
    )
    request = get_composable_node_load_request(node, context)
    values = [(each.name, parameter_value_to_python(each.value)) for each in request.parameters]
    assert values == [("b", 1), ("a", 2), ("z.y", 1)]
    assert (request.node_name, list(request.remap_rules)) == ("n", ["f:=t"])
    assert [node.package[0].text, node.node_plugin[0].text, node.node_name[0].text] == [
        "p",
        "P",
        "n",
    ]
    assert (len(node.parameters), len(node.remappings), len(node.extra_arguments)) == (2, 1, 1)
    unwanted = ComposableNode(package="p", plugin="P", condition=IfCondition("false"))
    assert unwanted.condition() is not None
    assert unwanted.parameters is unwanted.remappings is unwanted.extra_arguments is None
    assert get_composable_node_load_request(unwanted, context) is None


def test_an_empty_value_in_xml(context, tmp_path):
    xml = tmp_path / "a.launch.xml"
    xml.write_text(
        '<launch><node pkg="p" exec="e" namespace=""><param name="empty" value=""/></node></launch>'
    )
    root, parser = Parser.load(str(xml))
    (node,) = parser.parse_description(root).entities
    node._ros.expand_names(context)
    assert node._ros.name_rules()["ns"] == "__ns:=/"
    assert node._ros.evaluated_parameters(context) == [{"empty": ""}]


def test_actions_know_what_they_set(context, monkeypatch):
    monkeypatch.setenv("ROS_LOG_DIR", os.sep + "logs")
    below = SetROSLogDir("inner")
    below.execute(context)
    assert (below.log_dir[0].text, os.environ["ROS_LOG_DIR"]) == (
        "inner",
        os.path.join(os.sep + "logs", "inner"),
    )
    SetROSLogDir(os.sep + "other").execute(context)
    assert os.environ["ROS_LOG_DIR"] == os.sep + "other"
    assert SetUseSimTime(True).value is True
    setting = SetParameter("a", LaunchConfiguration("x"))
    setting.execute(context)
    assert (setting.name, setting.value) == ("a", 3)


def constants(kind, *prefixes, leave_out=()):
    names = {name for name in dir(kind) if name.startswith(prefixes)} - set(leave_out)
    return {
        getattr(kind, name): next(
            name.removeprefix(prefix) for prefix in prefixes if name.startswith(prefix)
        ).lower()
        for name in names
    }


def test_states_and_transitions_have_names():
    assert ChangeState.valid_states == constants(State, "PRIMARY_STATE_", "TRANSITION_STATE_")
    own = {name for name in dir(Transition) if "_ON_" in name or "CALLBACK" in name}
    assert ChangeState.valid_transitions == constants(Transition, "TRANSITION_", leave_out=own)
    assert set(LifecycleTransition.transition_targets) == set(range(1, 8))

    class Managed:
        node_name = "/ns/n"

    assert matches_node_name("ns/n")(Managed())
    assert not matches_node_name("n")(Managed())


def test_the_adapter_is_started_once():
    adapter = ROSAdapter(argv=["x"], autostart=False)
    assert (adapter.argv, adapter.ros_context) == (["launch_ros", "x"], None)
    with pytest.raises(RuntimeError, match="not running"):
        adapter.shutdown()
    adapter.start()
    try:
        assert adapter.ros_node.context is adapter.ros_context
        assert adapter.ros_node in adapter.ros_executor.get_nodes()
        with pytest.raises(RuntimeError, match="already running"):
            adapter.start()
    finally:
        adapter.shutdown()


def test_a_timer_waits_for_simulated_time(launch):
    from rosgraph_msgs.msg import Clock

    own = rclpy.Context()
    rclpy.init(context=own)
    node = rclpy.create_node("clock_of_the_test", context=own)
    publisher = node.create_publisher(Clock, "/clock", 10)
    ended = threading.Event()

    def advance():
        clock = Clock()
        while not ended.wait(0.02):
            clock.clock.sec += 10
            publisher.publish(clock)

    thread = threading.Thread(target=advance)
    thread.start()
    try:
        # Real seconds would exceed the time of the test.
        timer = ROSTimer(period=500.0, actions=[LogInfo(msg="the time has come")])
        outcome = launch(SetUseSimTime(True), timer)
    finally:
        ended.set()
        thread.join()
        node.destroy_node()
        rclpy.shutdown(context=own)
    assert outcome.messages == ["the time has come"]


@pytest.mark.parametrize(
    ("pattern", "matches"),
    [
        ("/**", True),
        ("/robot/arm/talker", True),
        ("/robot/*/talker", True),
        ("/**/talker", True),
        ("/*/talker", False),
        ("/robot/arm", False),
    ],
)
def test_names_of_nodes_in_parameter_files(pattern, matches):
    assert is_node_name_matched(pattern, "/robot/arm/talker") is matches


def test_the_manager_of_managed_nodes_has_ros_2_s_module():
    from launch_ros import utilities
    from launch_ros.utilities import lifecycle_event_manager

    manager = utilities.LifecycleEventManager(Node(executable="e"))
    assert type(manager) is lifecycle_event_manager.LifecycleEventManager
    assert manager.node_name is None
    for module in (utilities, lifecycle_event_manager):
        with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
            module.nothing  # noqa: B018  it is read


@pytest.mark.parametrize(
    "module",
    [
        "launch.actions.reset_launch_configurations",
        "launch.actions.timer_action",
        "launch_ros.actions.load_composable_nodes",
        "launch_ros.actions.ros_timer",
        "launch_ros.descriptions.composable_lifecycle_node",
    ],
)
def test_types_of_text_or_substitutions(module):
    kinds = importlib.import_module(module).SomeSubstitutionsType_types_tuple
    for value in (
        "text",
        Path("path"),
        TextSubstitution(text="x"),
        ["a", TextSubstitution(text="b")],
    ):
        assert isinstance(value, kinds)
    for value in (1, 2.5, None, True):
        assert not isinstance(value, kinds)


# Extensions of `Node`, which other packages add by entry points.

EXTENSION = """
from launch.substitutions import EnvironmentVariable
from launch_ros.actions.node import NodeActionExtension

class Secure(NodeActionExtension):
    def prepare_for_execute(self, context, ros_specific_arguments, node_action):
        words = ["--enclave", [EnvironmentVariable("ENCLAVE")]]
        return words, {**ros_specific_arguments, "ns": "__ns:=/moved"}

class Old(NodeActionExtension):
    EXTENSION_POINT_VERSION = "0.0"

class Broken(NodeActionExtension):
    def __init__(self):
        raise ValueError("no key")
"""


@pytest.fixture
def install(tmp_path, monkeypatch):
    """Makes a package with extensions; each argument is a name and an object of `EXTENSION`."""
    (tmp_path / "node_extensions_of_others.py").write_text(EXTENSION)
    monkeypatch.syspath_prepend(tmp_path)
    info = tmp_path / "others-1.0.dist-info"
    info.mkdir()

    def write(**found):
        lines = [f"{name} = node_extensions_of_others:{cls}" for name, cls in found.items()]
        text = "\n".join(["[launch_ros.node_action]", *lines, ""])
        (info / "entry_points.txt").write_text(text)
        extensions._entries.cache_clear()

    yield write
    extensions._entries.cache_clear()


def test_an_extension_adds_words_and_changes_names(install, launch, monkeypatch, tmp_path):
    monkeypatch.setenv("ENCLAVE", "/talker")
    install(secure="Secure")
    script = tmp_path / "show.py"
    script.write_text("#!/usr/bin/env python3\nimport sys; print(*sys.argv[1:])")
    script.chmod(0o755)
    node = Node(executable=str(script), name="talker", namespace="robot", output="screen")
    outcome = launch(node)
    words = "--ros-args -r __node:=talker -r __ns:=/moved --enclave /talker"
    assert words in outcome.text


def test_extensions_that_fail_are_left_out(install, caplog):
    install(secure="Secure", old="Old", broken="Broken", absent="Absent")
    found = get_extensions(logging.getLogger("test"))
    assert {name: each.NAME for name, each in found.items()} == {"secure": "secure"}
    told = {(line.levelname, line.getMessage().partition(": ")[0]) for line in caplog.records}
    group = "Failed to instantiate 'launch_ros.node_action' extension"
    assert told == {
        ("WARNING", f"{group} 'old'"),
        ("ERROR", f"{group} 'broken'"),
        ("WARNING", "Failed to load entry point 'absent'"),
    }


def test_instances_are_kept_unless_a_new_one_is_wanted():
    logger, kept = logging.getLogger("test"), {}
    first = instantiate_extension("group", "plain", NodeActionExtension, kept, logger)
    again = instantiate_extension("group", "plain", NodeActionExtension, kept, logger)
    other = instantiate_extension(
        "group", "plain", NodeActionExtension, kept, logger, unique_instance=True
    )
    assert kept == {"plain": first}
    assert again is first
    assert other is not first
    names = {"name": "__node:=talker"}
    assert first.prepare_for_execute(None, names, None) == ([], names)


def test_versions():
    satisfies_version("0.1.5", "^0.1")
    for version in ("0.0", "0.2"):
        with pytest.raises(PluginException):
            satisfies_version(version, "^0.1")
    assert get_upper_bound_caret_version("1.2.3") == "2.0.0"
