"""Managed nodes: their states, callbacks, publishers and services."""

import pytest

from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle import LifecycleNode, SimpleManagedEntity, State, TransitionCallbackReturn
from std_msgs.msg import Int32

SUCCESS, FAILURE, ERROR = TransitionCallbackReturn


class Managed(LifecycleNode):
    """Says what happens, and returns what the test wants."""

    def __init__(self, **arguments):
        super().__init__("managed", **arguments)
        self.calls = []
        self.outcomes = {}

    def _called(self, name, state):
        self.calls.append((name, state.label))
        outcome = self.outcomes.get(name, SUCCESS)
        if isinstance(outcome, Exception):
            raise outcome
        return outcome

    def on_configure(self, state):
        return self._called("configure", state)

    def on_cleanup(self, state):
        return self._called("cleanup", state)

    def on_shutdown(self, state):
        return self._called("shutdown", state)

    def on_error(self, state):
        return self._called("error", state)


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def middleware(request):
    return request.param


@pytest.fixture
def managed(context, executor):
    managed = Managed(context=context)
    executor.add_node(managed)
    yield managed
    managed.destroy_node()


def state_of(node):
    return node._state_machine.current_state.label


def test_the_whole_way(managed):
    assert state_of(managed) == "unconfigured"
    steps = ["configure", "activate", "deactivate", "cleanup", "configure", "shutdown"]
    states = ["inactive", "active", "inactive", "unconfigured", "inactive", "finalized"]
    for step, state in zip(steps, states, strict=True):
        assert getattr(managed, f"trigger_{step}")() is SUCCESS
        assert state_of(managed) == state
    assert managed.calls == [
        ("configure", "unconfigured"),
        ("cleanup", "inactive"),
        ("configure", "unconfigured"),
        ("shutdown", "inactive"),
    ]
    with pytest.raises(RCLError, match="no transition matching shutdown found"):
        managed.trigger_shutdown()


@pytest.mark.parametrize("step", ["activate", "deactivate", "cleanup"])
def test_a_step_that_does_not_lead_on_raises(managed, step):
    with pytest.raises(
        RCLError, match=f"no transition matching {step} found for current state unconfigured"
    ):
        getattr(managed, f"trigger_{step}")()


def test_a_failure_leads_back(managed):
    managed.outcomes["configure"] = FAILURE
    assert managed.trigger_configure() is FAILURE
    assert state_of(managed) == "unconfigured"


@pytest.mark.parametrize(
    ("after_error", "state"),
    [
        (SUCCESS, "unconfigured"),
        (FAILURE, "finalized"),
        (ERROR, "finalized"),
        (ValueError("x"), "finalized"),
    ],
)
@pytest.mark.parametrize("outcome", [ERROR, LookupError("wrong"), None])
def test_an_error_is_processed(managed, capfd, outcome, after_error, state):
    managed.outcomes.update(configure=outcome, error=after_error)
    assert managed.trigger_configure() is ERROR
    assert managed.calls == [("configure", "unconfigured"), ("error", "unconfigured")]
    assert state_of(managed) == state
    assert ("LookupError: wrong" in capfd.readouterr().err) == isinstance(outcome, LookupError)


def test_registered_callbacks_replace_the_methods(managed):
    assert managed.register_on_configure(
        lambda state: FAILURE if state == State("unconfigured", 1) else ERROR
    )
    assert managed.trigger_configure() is FAILURE
    assert managed.calls == []


def test_a_publisher_is_silent_unless_the_node_is_active(managed, node, spin_until):
    publisher = managed.create_lifecycle_publisher(Int32, "number", 10)
    got = []
    node.create_subscription(Int32, "number", lambda message: got.append(message.data), 10)
    publisher.publish(Int32(data=1))
    managed.trigger_configure()
    publisher.publish(Int32(data=2))
    managed.trigger_activate()
    assert publisher.is_activated
    publisher.publish(Int32(data=3))
    managed.trigger_deactivate()
    publisher.publish(Int32(data=4))
    spin_until(lambda: got)
    assert got == [3]
    assert managed.destroy_lifecycle_publisher(publisher)
    with pytest.raises(TypeError, match="publisher_class"):
        managed.create_lifecycle_publisher(Int32, "number", 10, publisher_class=object)


def test_when_enabled():
    class Lamp(SimpleManagedEntity):
        @SimpleManagedEntity.when_enabled(when_not_enabled=lambda self, text: f"dark {text}")
        def shine(self, text):
            return f"bright {text}"

    lamp = Lamp()
    assert lamp.shine("x") == "dark x"
    lamp.on_activate(None)
    assert lamp.shine("x") == "bright x"


def call(node, executor, srv_type, name, request=None):
    client = node.create_client(srv_type, f"managed/{name}")
    future = client.call_async(request or srv_type.Request())
    executor.spin_until_future_complete(future, timeout_sec=60)
    return future.result()


def test_services(managed, node, executor, capfd):
    assert call(node, executor, GetState, "get_state").current_state.label == "unconfigured"
    states = call(node, executor, GetAvailableStates, "get_available_states").available_states
    assert [(state.id, state.label) for state in states] == [
        (0, "unknown"),
        (1, "unconfigured"),
        (2, "inactive"),
        (3, "active"),
        (4, "finalized"),
        (10, "configuring"),
        (11, "cleaningup"),
        (12, "shuttingdown"),
        (13, "activating"),
        (14, "deactivating"),
        (15, "errorprocessing"),
    ]
    available = call(
        node, executor, GetAvailableTransitions, "get_available_transitions"
    ).available_transitions
    assert [
        (each.transition.id, each.transition.label, each.goal_state.label) for each in available
    ] == [(1, "configure", "configuring"), (5, "shutdown", "shuttingdown")]
    graph = call(
        node, executor, GetAvailableTransitions, "get_transition_graph"
    ).available_transitions
    assert len(graph) == 25
    request = ChangeState.Request(transition=Transition(id=Transition.TRANSITION_CONFIGURE))
    assert call(node, executor, ChangeState, "change_state", request).success
    assert state_of(managed) == "inactive"
    request = ChangeState.Request(transition=Transition(label="activate"))
    assert call(node, executor, ChangeState, "change_state", request).success
    assert state_of(managed) == "active"
    assert not call(node, executor, ChangeState, "change_state", request).success
    assert "no transition matching activate" in capfd.readouterr().err


def test_transition_events(managed, node, spin_until):
    events = []
    node.create_subscription(TransitionEvent, "managed/transition_event", events.append, 10)
    managed.trigger_configure()
    spin_until(lambda: len(events) == 2)
    assert [(event.start_state.label, event.goal_state.label) for event in events] == [
        ("unconfigured", "configuring"),
        ("configuring", "inactive"),
    ]


def test_without_services(context):
    managed = Managed(
        context=context, enable_communication_interface=False, start_parameter_services=False
    )
    assert not any("change_state" in service.srv_name for service in managed.services)
    assert managed.trigger_configure() is SUCCESS


def test_a_destroyed_publisher_takes_part_in_no_transition(managed):
    gone, kept = (managed.create_lifecycle_publisher(Int32, topic, 1) for topic in ("a", "b"))
    managed.trigger_configure()
    assert managed.destroy_lifecycle_publisher(gone)
    managed.trigger_activate()
    assert (gone.is_activated, kept.is_activated) == (False, True)
    assert not managed.destroy_lifecycle_publisher(gone)
