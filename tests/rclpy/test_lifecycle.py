from __future__ import annotations

import pytest

from lifecycle_msgs.msg import State, Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy._rclpy_pybind11 import RCLError
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode, LifecycleState, SimpleManagedEntity, TransitionCallbackReturn
from rclpy.lifecycle import Node as NodeAlias
from rclpy.lifecycle.state_machine import STATES, TRANSITIONS, StateMachine
from rclpy.node import Node
from std_msgs.msg import String

SUCCESS, FAILURE, ERROR = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE, TransitionCallbackReturn.ERROR


def constants(message_class, start):
    return {getattr(message_class, name) for name in dir(message_class) if name.startswith(start)}


def test_the_numbers_are_those_of_the_messages():
    assert {state.state_id for state in STATES} == constants(State, ("PRIMARY_STATE_", "TRANSITION_STATE_"))
    outside = {Transition.TRANSITION_CREATE, Transition.TRANSITION_DESTROY}
    callbacks = {SUCCESS, FAILURE, ERROR}
    assert constants(Transition, "TRANSITION_CALLBACK_") == callbacks
    assert {each.transition_id for each in TRANSITIONS} == constants(Transition, "TRANSITION_") - outside - callbacks
    assert len(TRANSITIONS) == 25


def test_every_transition_starts_and_ends_where_it_says():
    for transition in TRANSITIONS:
        machine = StateMachine()
        machine._state = transition.start
        assert machine.trigger(transition.transition_id) == transition
        assert machine.current_state == transition.goal


def test_a_wrong_transition(capfd):
    machine = StateMachine()
    with pytest.raises(RCLError) as caught:
        machine.trigger("activate")
    assert str(caught.value) == "Failed to trigger lifecycle state machine transition: Transition is not registered."
    assert "[rcl_lifecycle]: No transition matching activate found for current state unconfigured" in capfd.readouterr().err
    assert machine.current_state.label == "unconfigured"


class Talker(LifecycleNode):
    """Records its callbacks; `answers` says what they return or raise."""

    def __init__(self, context, **keywords):
        self.calls = []
        self.answers = {}
        super().__init__("talker", context=context, start_parameter_services=False, **keywords)
        self.publisher = self.create_lifecycle_publisher(String, "chatter", 10)

    def answer(self, name, state, default):
        self.calls.append((name, state))
        answer = self.answers.get(name)
        if isinstance(answer, Exception):
            raise answer
        return default(state) if answer is None else answer

    def on_configure(self, state):
        return self.answer("configure", state, super().on_configure)

    def on_activate(self, state):
        return self.answer("activate", state, super().on_activate)

    def on_deactivate(self, state):
        return self.answer("deactivate", state, super().on_deactivate)

    def on_cleanup(self, state):
        return self.answer("cleanup", state, super().on_cleanup)

    def on_shutdown(self, state):
        return self.answer("shutdown", state, super().on_shutdown)

    def on_error(self, state):
        return self.answer("error", state, super().on_error)

    @property
    def state(self):
        return self._state_machine.current_state.label


@pytest.fixture
def talker(context):
    talker = Talker(context)
    yield talker
    talker.destroy_node()


def test_through_all_states(talker):
    assert NodeAlias is LifecycleNode
    assert talker.state == "unconfigured"
    for trigger, state in (
        (talker.trigger_configure, "inactive"),
        (talker.trigger_activate, "active"),
        (talker.trigger_deactivate, "inactive"),
        (talker.trigger_cleanup, "unconfigured"),
        (talker.trigger_shutdown, "finalized"),
    ):
        assert trigger() is SUCCESS
        assert talker.state == state
    assert talker.calls == [
        ("configure", LifecycleState("unconfigured", 1)),
        ("activate", LifecycleState("inactive", 2)),
        ("deactivate", LifecycleState("active", 3)),
        ("cleanup", LifecycleState("inactive", 2)),
        ("shutdown", LifecycleState("unconfigured", 1)),
    ]
    with pytest.raises(RCLError, match=r"^Shutdown transition not possible$"):
        talker.trigger_shutdown()


@pytest.mark.parametrize(
    ("answers", "returned", "state"),
    [
        ({"configure": FAILURE}, FAILURE, "unconfigured"),
        ({"configure": ERROR}, ERROR, "unconfigured"),
        ({"configure": ERROR, "error": FAILURE}, ERROR, "finalized"),
        ({"configure": ERROR, "error": ERROR}, ERROR, "finalized"),
        ({"configure": ValueError("broken")}, ERROR, "unconfigured"),
        ({"configure": ValueError("broken"), "error": ValueError("too")}, ERROR, "finalized"),
        ({"configure": True}, ERROR, "unconfigured"),
    ],
)
def test_failures_and_errors(talker, capfd, answers, returned, state):
    talker.answers = answers
    assert talker.trigger_configure() is returned
    assert talker.state == state
    assert ("error" in [name for name, _ in talker.calls]) == (returned is ERROR)
    shown = capfd.readouterr().err
    if isinstance(answers["configure"], Exception):
        assert "on_configure() raised an exception: Traceback" in shown
        assert "ValueError: broken" in shown
    if answers["configure"] is True:
        assert "on_configure() returned True; it has to return a TransitionCallbackReturn" in shown


def test_publishers_speak_while_active(context, talker):
    executor = SingleThreadedExecutor(context=context)
    listener = Node("listener", context=context, start_parameter_services=False)
    executor.add_node(listener)
    heard = []
    listener.create_subscription(String, "chatter", lambda message: heard.append(message.data), 10)

    def say(text):
        talker.publisher.publish(String(data=text))

    say("unconfigured")
    talker.trigger_configure()
    say("inactive")
    talker.trigger_activate()
    assert talker.publisher.is_activated
    say("active")
    talker.trigger_deactivate()
    say("inactive again")
    for _ in range(5):
        executor.spin_once(timeout_sec=0.05)
    assert heard == ["active"]
    assert talker.destroy_lifecycle_publisher(talker.publisher)
    assert talker.trigger_activate() is SUCCESS
    executor.shutdown()
    listener.destroy_node()


def test_a_publisher_class_cannot_be_given(talker):
    with pytest.raises(TypeError, match="unexpected keyword argument 'publisher_class'"):
        talker.create_lifecycle_publisher(String, "x", 1, publisher_class=object)


def test_managed_entities(talker):
    class Arm(SimpleManagedEntity):
        def on_configure(self, state):
            return FAILURE

        @SimpleManagedEntity.when_enabled
        def move(self):
            return "moved"

        @SimpleManagedEntity.when_enabled(when_not_enabled=lambda: "locked")
        def grip(self):
            return "gripped"

    arm = Arm()
    assert (arm.move(), arm.grip()) == (None, "locked")
    arm.on_activate(LifecycleState("inactive", 2))
    assert (arm.move(), arm.grip()) == ("moved", "gripped")
    talker.add_managed_entity(arm)
    assert talker.trigger_configure() is FAILURE
    assert talker.state == "unconfigured"


@pytest.fixture
def ask(context, talker):
    executor = SingleThreadedExecutor(context=context)
    asker = Node("asker", context=context, start_parameter_services=False)
    executor.add_node(talker)
    executor.add_node(asker)

    def ask(service_type, name, request=None):
        client = asker.create_client(service_type, f"talker/{name}")
        assert client.wait_for_service(timeout_sec=20)
        future = client.call_async(request or service_type.Request())
        executor.spin_until_future_complete(future, timeout_sec=20)
        return future.result()

    yield ask
    executor.shutdown()
    asker.destroy_node()


def change(ask, **transition):
    return ask(ChangeState, "change_state", ChangeState.Request(transition=Transition(**transition))).success


def test_the_services(ask):
    assert ask(GetState, "get_state").current_state == State(id=1, label="unconfigured")
    assert change(ask, id=Transition.TRANSITION_CONFIGURE)
    assert ask(GetState, "get_state").current_state == State(id=2, label="inactive")
    assert change(ask, label="activate")
    states = ask(GetAvailableStates, "get_available_states").available_states
    assert [(each.id, each.label) for each in states] == [(state.state_id, state.label) for state in STATES]
    here = ask(GetAvailableTransitions, "get_available_transitions").available_transitions
    assert [(each.transition.id, each.transition.label, each.start_state.label, each.goal_state.label) for each in here] == [
        (4, "deactivate", "active", "deactivating"),
        (7, "shutdown", "active", "shuttingdown"),
    ]
    assert len(ask(GetAvailableTransitions, "get_transition_graph").available_transitions) == len(TRANSITIONS)


def test_a_wrong_request_is_answered(ask, talker, capfd):
    """In ROS 2 it ends the program."""
    assert not change(ask, id=Transition.TRANSITION_ACTIVATE)
    assert not change(ask, label="fly")
    assert talker.state == "unconfigured"
    assert "[talker]: Failed to trigger lifecycle state machine transition: Transition is not registered." in capfd.readouterr().err
    talker.answers = {"configure": FAILURE}
    assert not change(ask, label="configure")


def test_transitions_are_published(context, talker):
    executor = SingleThreadedExecutor(context=context)
    listener = Node("listener", context=context, start_parameter_services=False)
    executor.add_node(listener)
    events = []
    listener.create_subscription(TransitionEvent, "/talker/transition_event", events.append, 10)
    talker.trigger_configure()
    for _ in range(100):
        if len(events) == 2:
            break
        executor.spin_once(timeout_sec=0.1)
    shown = [(each.transition.label, each.start_state.label, each.goal_state.label) for each in events]
    assert shown == [("configure", "unconfigured", "configuring"), ("transition_success", "configuring", "inactive")]
    assert all(event.timestamp > 10**18 for event in events)
    executor.shutdown()
    listener.destroy_node()


def test_without_communication(context):
    silent = LifecycleNode("silent", context=context, enable_communication_interface=False, start_parameter_services=False)
    assert silent.trigger_configure() is SUCCESS
    assert [service.srv_name for service in silent.services if "state" in service.srv_name] == []
    silent.destroy_node()
