"""Managed nodes, and timers of ROS."""

from __future__ import annotations

import sys

import pytest

from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    IncludeLaunchDescription,
    LogInfo,
    RegisterEventHandler,
    Shutdown,
)
from launch.event_handlers import OnExecutionComplete
from launch.events.matchers import matches_action
from launch_ros.actions import LifecycleNode, LifecycleTransition, RosTimer, SetUseSimTime
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition

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
    script = tmp_path / "managed"
    script.write_text(MANAGED)
    script.chmod(0o755)
    return LifecycleNode(executable=str(script), name="m", namespace="ns", output="screen")


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
