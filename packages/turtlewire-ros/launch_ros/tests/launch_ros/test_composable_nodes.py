"""Nodes in the process of a container."""

import pytest

from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    IncludeLaunchDescription,
    RegisterEventHandler,
    SetLaunchConfiguration,
    Shutdown,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnExecutionComplete, OnProcessIO
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import (
    ComposableNodeContainer,
    LoadComposableNodes,
    PushRosNamespace,
    SetParameter,
    SetRemap,
)
from launch_ros.descriptions import ComposableNode

MODULE = """
from rclpy.node import Node

class Shows(Node):
    def __init__(self):
        super().__init__("shows")
        self.declare_parameters("", [("speed", 1), ("colour", "red")])
        values = [self.get_parameter(name).value for name in ("speed", "colour")]
        print("HERE", self.get_fully_qualified_name(), self.resolve_topic_name("a"), *values)
"""


@pytest.fixture(autouse=True)
def shows(tmp_path, monkeypatch):
    """The module `shows` with the component `Shows`, for the container's process."""
    (tmp_path / "shows.py").write_text(MODULE)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))


def component(**options):
    return ComposableNode(package="shows", plugin="shows.Shows", **options)


def until_loaded(container_or_load):
    """End the launch when the last nodes were loaded."""

    def is_load(action):
        return isinstance(action, LoadComposableNodes)

    matcher = container_or_load if isinstance(container_or_load, LoadComposableNodes) else is_load
    return RegisterEventHandler(
        OnExecutionComplete(target_action=matcher, on_completion=[Shutdown()])
    )


def here(outcome):
    return [line.split("] HERE ")[1] for line in outcome.lines if "] HERE " in line]


def test_nodes_of_a_container(launch):
    container = ComposableNodeContainer(
        name="box",
        output="screen",
        composable_node_descriptions=[
            component(),
            component(
                name="n",
                namespace="ns",
                parameters=[{"speed": 2, "colour": "5"}],
                remappings=[("a", "b")],
            ),
            component(name="unwanted", condition=UnlessCondition("true")),
            component(
                name="wanted",
                condition=IfCondition("true"),
                parameters=[{"colour": LaunchConfiguration("colour")}],
            ),
        ],
    )
    outcome = launch(
        until_loaded(container),
        SetLaunchConfiguration("colour", "green"),
        SetLaunchConfiguration("sigterm_timeout", "120"),  # under load, an exit takes a while
        container,
    )
    assert outcome.status == 0, outcome.text
    assert here(outcome) == ["/shows /a 1 red", "/ns/n /ns/b 2 5", "/wanted /a 1 green"]
    loaded = [line.split("]: ")[1] for line in outcome.lines if "Loaded node" in line]
    assert loaded == [
        f"Loaded node '{name}' in container '/box'" for name in ("/shows", "/ns/n", "/wanted")
    ]
    assert (
        outcome.text.count("process started with pid")
        == outcome.text.count("process has finished cleanly")
        == 1
    )


def test_scope_additions_and_files(launch, tmp_path):
    (tmp_path / "params.yaml").write_text(
        "/**: {ros__parameters: {speed: 1}}\n/robot/n: {ros__parameters: {speed: 7}}\n/other: "
        "{ros__parameters: {speed: 8}}"
    )
    container = ComposableNodeContainer(
        name="box",
        output="screen",
        composable_node_descriptions=[
            component(name="n", parameters=[str(tmp_path / "params.yaml")])
        ],
    )
    scope = [PushRosNamespace("robot"), SetParameter("colour", "blue"), SetRemap("a", "c")]
    outcome = launch(until_loaded(container), *scope, container)
    assert here(outcome) == ["/robot/n /robot/c 7 blue"]
    assert "Loaded node '/robot/n' in container '/robot/box'" in outcome.text


def test_unloadable_files(launch):
    container = ComposableNodeContainer(
        name="box",
        composable_node_descriptions=[
            ComposableNode(package="shows", plugin="shows.Nobody", name="n"),
            component(name="m"),
            component(name="m"),
        ],
    )
    outcome = launch(until_loaded(container), container)
    failed = (
        "Failed to load node 'n' of type 'shows.Nobody' in container '/box': AttributeError: "
        "module 'shows' has no attribute 'Nobody'"
    )
    assert f"[ERROR] [launch_ros.actions.load_composable_nodes]: {failed}" in outcome.lines
    assert (
        "there are now at least 2 nodes with the name /m created within this launch context"
        in outcome.text
    )
    assert outcome.status == 0


def test_loading_into_a_container_by_its_name(launch):
    load = LoadComposableNodes(
        target_container="box", composable_node_descriptions=[component(name="late")]
    )
    container = ComposableNodeContainer(name="box", output="screen")
    outcome = launch(until_loaded(load), load, container)
    assert here(outcome) == ["/late /a 1 red"]


def test_a_container_that_ends_before(launch):
    container = ComposableNodeContainer(
        name="box",
        arguments=["--ros-args", "-r", "nonsense"],
        composable_node_descriptions=[component()],
    )
    outcome = launch(container)  # the container ends at once, and nothing waits for it
    assert "process has died" in outcome.text
    assert outcome.status == 0


def test_the_end_of_the_launch_ends_the_wait_for_a_container(launch):
    load = LoadComposableNodes(
        target_container="nowhere", composable_node_descriptions=[component()]
    )
    ready = ExecuteProcess(cmd=["echo", "ready"])
    end = RegisterEventHandler(
        OnProcessIO(target_action=ready, on_stdout=lambda _: EmitEvent(event=Shutdown().event))
    )
    outcome = launch(end, load, ready)
    assert (
        "Abandoning wait for the '/nowhere/_container/load_node' service, due to shutdown."
        in outcome.text
    )
    assert outcome.status == 0


@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_launch_files_in_other_languages(launch, tmp_path, language):
    xml = """<launch>
      <node_container pkg="rclpy_components" exec="component_container" name="box" namespace=""
                      output="screen">
        <composable_node pkg="shows" plugin="shows.Shows" name="n" namespace="ns">
          <param name="speed" value="3"/> <remap from="a" to="b"/>
          <extra_arg name="use_intra_process_comms" value="true"/>
        </composable_node>
        <composable_node pkg="shows" plugin="shows.Shows" if="false"/>
      </node_container>
      <load_composable_node target="/box">
        <composable_node pkg="shows" plugin="shows.Shows" name="late"/>
      </load_composable_node>
    </launch>"""
    yaml = """launch:
- node_container:
    pkg: rclpy_components
    exec: component_container
    name: box
    namespace: ""
    output: screen
    composable_node:
    - {pkg: shows, plugin: shows.Shows, name: n, namespace: ns, param: [{name: speed, value: 3}],
       remap: [{from: a, to: b}], extra_arg: [{name: use_intra_process_comms, value: true}]}
    - {pkg: shows, plugin: shows.Shows, if: "false"}
- load_composable_node:
    target: /box
    composable_node: [{pkg: shows, plugin: shows.Shows, name: late}]
"""
    path = tmp_path / f"x.launch.{language}"
    path.write_text(xml if language == "xml" else yaml)
    done = []

    def finish(_event, _context):
        done.append(1)
        return Shutdown() if len(done) == 2 else None

    handler = OnExecutionComplete(
        target_action=lambda action: isinstance(action, LoadComposableNodes), on_completion=finish
    )
    outcome = launch(RegisterEventHandler(handler), IncludeLaunchDescription(str(path)))
    assert sorted(here(outcome)) == ["/late /a 1 red", "/ns/n /ns/b 3 red"], outcome.text


def test_requests_can_be_made_without_a_container(context):
    request = component(extra_arguments=[{"use_intra_process_comms": True}]).load_request(context)
    assert (request.package_name, request.plugin_name, request.node_name) == (
        "shows",
        "shows.Shows",
        "",
    )
    assert request.extra_arguments[0].name == "use_intra_process_comms"
    assert request.extra_arguments[0].value.bool_value is True
