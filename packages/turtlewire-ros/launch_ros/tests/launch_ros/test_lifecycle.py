"""Managed nodes, and timers of ROS."""

import asyncio
import sys
from types import SimpleNamespace

import pytest

from launch import LaunchDescription, LaunchService
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    Shutdown,
)
from launch.event_handlers import OnExecutionComplete
from launch.events.matchers import matches_action
from launch_ros.actions import (
    ComposableNodeContainer,
    LifecycleNode,
    LifecycleTransition,
    RosTimer,
    SetUseSimTime,
)
from launch_ros.actions.lifecycle_transition import match_node_name_goal, match_node_name_start_goal
from launch_ros.descriptions import ComposableLifecycleNode
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_adapter, get_ros_node
from lifecycle_msgs.msg import State, Transition, TransitionEvent

MANAGED = """#!/usr/bin/env python3
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

class Managed(LifecycleNode):
    def on_activate(self, state):
        print("ACTIVE", flush=True)
        return super().on_activate(state)

    def on_deactivate(self, state):
        return TransitionCallbackReturn.FAILURE

rclpy.init()
try:
    rclpy.spin(Managed("managed"))
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""


@pytest.fixture
def managed(tmp_path):
    return LifecycleNode(
        executable=managed_script(tmp_path), name="m", namespace="ns", output="screen"
    )


def managed_script(tmp_path):
    script = tmp_path / "managed"
    script.write_text(MANAGED)
    script.chmod(0o755)
    return str(script)


def test_states_become_events_and_events_change_states(launch, managed):
    def change(transition):
        return EmitEvent(
            event=ChangeState(
                lifecycle_node_matcher=matches_action(managed), transition_id=transition
            )
        )

    seen = []

    def remember(event, _context):
        seen.append((event.transition, event.start_state, event.goal_state))

    outcome = launch(
        RegisterEventHandler(OnStateTransition(entities=remember)),
        RegisterEventHandler(
            OnStateTransition(
                target_lifecycle_node=managed, goal_state="active", entities=[Shutdown()]
            )
        ),
        RegisterEventHandler(
            OnStateTransition(
                goal_state="inactive", entities=[change(Transition.TRANSITION_ACTIVATE)]
            )
        ),
        managed,
        change(Transition.TRANSITION_CONFIGURE),
    )
    assert outcome.status == 0, outcome.text
    assert "] ACTIVE" in outcome.text
    assert [states[1:] for states in seen] == [
        ("unconfigured", "configuring"),
        ("configuring", "inactive"),
        ("inactive", "activating"),
        ("activating", "active"),
    ]


@pytest.mark.parametrize(
    ("change", "goal", "start_and_goal"),
    [
        ({}, True, True),
        ({"node": "/other"}, False, False),
        ({"goal": "active"}, False, False),
        ({"start": "active"}, True, False),
    ],
)
def test_matchers_of_states(change, goal, start_and_goal):
    event = StateTransition(
        action=SimpleNamespace(node_name=change.get("node", "/ns/m")),
        msg=TransitionEvent(
            start_state=State(label=change.get("start", "unconfigured")),
            goal_state=State(label=change.get("goal", "inactive")),
        ),
    )
    assert match_node_name_goal("/ns/m", "inactive")(event) is goal
    matches = match_node_name_start_goal("/ns/m", "unconfigured", "inactive")
    assert matches(event) is start_and_goal
    assert not matches(Shutdown())


def test_a_node_that_starts_itself(launch, tmp_path, managed):
    node = LifecycleNode(
        executable=managed_script(tmp_path),
        name="m",
        namespace="ns",
        output="screen",
        autostart=True,
    )
    assert (managed.node_autostart, node.node_autostart) == (False, True)
    assert node.is_lifecycle_node
    assert node.get_lifecycle_event_manager() is None
    active = OnStateTransition(
        target_lifecycle_node=node, goal_state="active", entities=[Shutdown()]
    )
    outcome = launch(RegisterEventHandler(active), node)
    assert outcome.status == 0, outcome.text
    assert "] ACTIVE" in outcome.text
    assert node.get_lifecycle_event_manager().node_name == "/ns/m"


def test_a_launch_ends_although_a_node_that_starts_itself_crashed(launch):
    node = LifecycleNode(
        executable=sys.executable, arguments=["-c", ""], name="m", namespace="", autostart=True
    )
    assert "process has finished cleanly" in launch(node).text


COMPONENT = """
from rclpy.lifecycle import LifecycleNode

class Managed(LifecycleNode):
    def __init__(self):
        super().__init__("managed")

    def on_activate(self, state):
        print("ACTIVE", self.get_fully_qualified_name(), flush=True)
        return super().on_activate(state)
"""


def test_managed_nodes_of_a_container(launch, tmp_path, monkeypatch):
    (tmp_path / "managed_component.py").write_text(COMPONENT)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))

    def described(name, **options):
        return ComposableLifecycleNode(
            package="managed_component",
            plugin="managed_component.Managed",
            name=name,
            namespace="ns",
            **options,
        )

    first, second = described("first", autostart=True), described("second")
    assert (first.node_autostart, second.node_autostart) == (True, False)
    change = ChangeState(
        lifecycle_node_matcher=matches_node_name("/ns/second"),
        transition_id=Transition.TRANSITION_CONFIGURE,
    )
    container = ComposableNodeContainer(
        name="box", output="screen", composable_node_descriptions=[first, second]
    )
    outcome = launch(
        RegisterEventHandler(
            OnStateTransition(
                target_lifecycle_node=first, goal_state="active", entities=[EmitEvent(event=change)]
            )
        ),
        RegisterEventHandler(
            OnStateTransition(
                target_lifecycle_node=second, goal_state="inactive", entities=[Shutdown()]
            )
        ),
        container,
    )
    assert outcome.status == 0, outcome.text
    assert outcome.text.count("] ACTIVE") == outcome.text.count("] ACTIVE /ns/first") == 1


def test_transitions_one_after_the_other(launch, managed):
    transitions = LifecycleTransition(
        lifecycle_node_names=["ns/m"],
        transition_ids=[Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE],
    )
    done = RegisterEventHandler(
        OnExecutionComplete(target_action=transitions, on_completion=[Shutdown()])
    )
    outcome = launch(done, managed, transitions)
    assert outcome.status == 0, outcome.text
    assert "] ACTIVE" in outcome.text
    assert matches_node_name("/ns/m")(managed)
    assert not matches_node_name("m")(managed)


def test_a_transition_that_fails_ends_those_of_its_node(launch, managed):
    ids = [
        Transition.TRANSITION_CONFIGURE,
        Transition.TRANSITION_ACTIVATE,
        Transition.TRANSITION_DEACTIVATE,
        Transition.TRANSITION_CLEANUP,
    ]
    transitions = LifecycleTransition(lifecycle_node_names=["/ns/m"], transition_ids=ids)
    done = RegisterEventHandler(
        OnExecutionComplete(target_action=transitions, on_completion=[Shutdown()])
    )
    outcome = launch(done, managed, transitions)
    assert (
        outcome.text.count(
            "Failed to make transition 'TRANSITION_DEACTIVATE' for LifecycleNode '/ns/m'"
        )
        == 1
    )
    assert "TRANSITION_CLEANUP" not in outcome.text


def test_the_end_of_the_launch_ends_the_wait_for_a_node(launch):
    transitions = LifecycleTransition(
        lifecycle_node_names=["nowhere"], transition_ids=[Transition.TRANSITION_CONFIGURE]
    )
    ends = ExecuteProcess(cmd=[sys.executable, "-c", ""], on_exit=Shutdown())
    outcome = launch(transitions, ends)
    assert (
        "Abandoning wait for the '/nowhere/change_state' service response, due to shutdown."
        in outcome.text
    )
    assert outcome.status == 0


def test_transitions_need_nodes_and_ids():
    with pytest.raises(RuntimeError, match="No lifecycle_node_names provided"):
        LifecycleTransition(lifecycle_node_names=[], transition_ids=[1])
    with pytest.raises(RuntimeError, match="No transition_ids provided"):
        LifecycleTransition(lifecycle_node_names=["a"], transition_ids=[])


def test_ros_timers(launch, tmp_path):
    assert launch(RosTimer(period=0.01, actions=[LogInfo(msg="ticked")])).messages == ["ticked"]
    (tmp_path / "x.launch.xml").write_text(
        "<launch><ros_timer period='0.01'><log message='ticked'/></ros_timer></launch>"
    )
    assert launch(IncludeLaunchDescription(str(tmp_path / "x.launch.xml"))).messages == ["ticked"]


def test_ros_timers_follow_the_clock_of_the_scope(launch):
    # Nobody publishes /clock: the time stands still, until the launch ends.
    still = RosTimer(period=0.001, actions=[LogInfo(msg="never")])
    ends = ExecuteProcess(cmd=[sys.executable, "-c", ""], on_exit=Shutdown())
    assert launch(SetUseSimTime(True), still, ends).messages == []


def test_ros_timers_leave_the_node_when_they_have_fired(launch):
    left = []

    def look(context):
        left.extend(get_ros_node(context).timers)

    assert launch(RosTimer(period=0.01, actions=[OpaqueFunction(function=look)])).status == 0
    assert left == []


def test_ros_timers_leave_the_node_when_they_are_cancelled(launch):
    timer, seen = RosTimer(period=100.0, actions=[]), []

    def cancel(context):
        seen.append(len(list(get_ros_node(context).timers)))
        timer.cancel()
        seen.append(len(list(get_ros_node(context).timers)))

    assert launch(timer, OpaqueFunction(function=cancel)).status == 0
    assert seen == [1, 0]


@pytest.mark.parametrize("cancel_on_shutdown", [True, False])
def test_the_end_of_a_launch_cancels_ros_timers(launch, cancel_on_shutdown):
    late = RosTimer(
        period=100.0, actions=[LogInfo(msg="never")], cancel_on_shutdown=cancel_on_shutdown
    )
    outcome = launch(late, Shutdown())
    assert (outcome.status, outcome.messages) == (0, [])
    assert late.get_asyncio_future().done()


def test_two_shutdowns_end_the_node_of_a_launch_once(launch):
    outcome = launch(RosTimer(period=0.01, actions=[Shutdown(), Shutdown()]))
    assert (outcome.status, "adapter" in outcome.text) == (0, False)


def test_each_run_of_a_launch_has_its_own_node(caplog):
    service = LaunchService(noninteractive=True)
    for _ in range(2):
        timer = RosTimer(period=0.01, actions=[LogInfo(msg="ticked")])
        service.include_launch_description(LaunchDescription([timer]))
        assert service.run() == 0
    assert service.run() == 0
    assert caplog.messages.count("ticked") == 2


def test_a_cancelled_launch_ends_its_node():
    service = LaunchService(noninteractive=True)
    cancel = OpaqueFunction(function=lambda _: service.task.cancel() and None)
    timer = RosTimer(period=0.01, actions=[cancel])
    service.include_launch_description(LaunchDescription([timer]))
    with pytest.raises(asyncio.CancelledError):
        service.run(shutdown_when_idle=False)
    assert get_ros_adapter(service.context).has_ended


def test_a_managed_node_does_not_start_during_the_shutdown(context, managed):
    context._run.is_shutdown = True
    assert managed.execute(context) is None
    assert managed.get_lifecycle_event_manager() is None


def test_elements_of_managed_nodes(launch, tmp_path, monkeypatch):
    (tmp_path / "managed_component.py").write_text(COMPONENT)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    path = tmp_path / "x.launch.xml"
    path.write_text(f"""
    <launch>
      <let name="yes" value="true"/>
      <lifecycle_node name="m" namespace="ns" exec="{managed_script(tmp_path)}"
          autostart="$(var yes)" output="screen"/>
      <node_container name="box" namespace="" pkg="rclpy_components" exec="component_container"
          output="screen">
        <composable_lifecycle_node pkg="managed_component" plugin="managed_component.Managed"
            name="first" namespace="ns" autostart="True"/>
        <composable_lifecycle_node pkg="managed_component" plugin="managed_component.Managed"
            name="second" namespace="ns"/>
      </node_container>
    </launch>
    """)
    missing = {"/ns/m", "/ns/first"}

    def on_active(context):
        event = context.locals.event
        missing.discard(
            event.action.node_name if isinstance(event.action, LifecycleNode) else "/ns/first"
        )
        return [] if missing else [Shutdown()]

    outcome = launch(
        RegisterEventHandler(
            OnStateTransition(goal_state="active", entities=[OpaqueFunction(function=on_active)])
        ),
        IncludeLaunchDescription(str(path)),
    )
    assert outcome.status == 0, outcome.text
    assert "] ACTIVE /ns/first" in outcome.text
    assert "/ns/second" in outcome.text
    assert "] ACTIVE /ns/second" not in outcome.text


def test_elements_of_managed_nodes_that_are_wrong(launch, tmp_path):
    path = tmp_path / "x.launch.xml"
    path.write_text("<launch><load_composable_node target='/box'/></launch>")
    text = launch(IncludeLaunchDescription(str(path))).text
    assert "Must provide at least one composable_node or composable_lifecycle_node" in text
    path.write_text(
        "<launch><lifecycle_node name='m' namespace='' exec='true' autostart='perhaps'/></launch>"
    )
    assert (
        "Attribute 'autostart' of Entity 'lifecycle_node'"
        in launch(IncludeLaunchDescription(str(path))).text
    )
