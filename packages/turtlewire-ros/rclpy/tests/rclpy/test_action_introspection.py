"""Events of action clients and servers, on both middlewares."""

import pytest

from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState

SERVICES = {
    "send_goal": Fibonacci.Impl.SendGoalService,
    "cancel_goal": Fibonacci.Impl.CancelGoalService,
    "get_result": Fibonacci.Impl.GetResultService,
}
CONTENTS = ServiceIntrospectionState.CONTENTS
METADATA = ServiceIntrospectionState.METADATA
OFF = ServiceIntrospectionState.OFF


@pytest.fixture(params=["local", "rmw_cyclonedds_cpp"])
def middleware(request):
    return request.param


@pytest.fixture
def server(node):
    server = ActionServer(
        node,
        Fibonacci,
        "fibonacci",
        lambda _: Fibonacci.Result(),
        handle_accepted_callback=lambda _: None,  # the test executes it
        cancel_callback=lambda _: CancelResponse.ACCEPT,
    )
    yield server
    server.destroy()


@pytest.fixture
def client(node):
    client = ActionClient(node, Fibonacci, "fibonacci")
    yield client
    client.destroy()


@pytest.fixture
def events(node):
    """The events of each of the action's services."""
    heard = {name: [] for name in SERVICES}
    for name, service in SERVICES.items():
        topic = f"fibonacci/_action/{name}/_service_event"
        node.create_subscription(service.Event, topic, heard[name].append, 100)
    return heard


def publishers(node):
    topics = [f"/fibonacci/_action/{name}/_service_event" for name in SERVICES]
    return [node.count_publishers(topic) for topic in topics]


def configure(endpoint, state):
    clock = endpoint._node.get_clock()
    endpoint.configure_introspection(clock, qos_profile_system_default, state)


def send_and_cancel(client, server, executor):
    """Send a goal, cancel it, and get its result."""
    handles = []
    server.register_handle_accepted_callback(handles.append)

    def finish(future):
        executor.spin_until_future_complete(future, timeout_sec=60)
        return future.result()

    goal = finish(client.send_goal_async(Fibonacci.Goal(order=7)))
    result = goal.get_result_async()
    assert len(finish(goal.cancel_goal_async()).goals_canceling) == 1
    handles[0].canceled(Fibonacci.Result(sequence=[1, 2]))
    finish(result)
    return goal


def matched(*ends):
    """Whether the events of each end have a subscription; introspection is on at all of them."""
    return all(
        part._events.wire.subscription_count()
        for end in ends
        for part in end._parts
        if hasattr(part, "_events")
    )


def test_events_of_an_action(node, client, server, events, context, executor, spin_until):
    configure(client, METADATA)
    configure(server, CONTENTS)
    assert client.wait_for_server(timeout_sec=60)
    assert context.wait_for_graph(
        lambda: publishers(node) == [2, 2, 2] and matched(client, server), 60_000_000_000
    )
    goal = send_and_cancel(client, server, executor)
    spin_until(lambda: [len(each) for each in events.values()] == [4, 4, 4])
    by_kind = {
        name: {event.info.event_type: event for event in each} for name, each in events.items()
    }
    for kinds in by_kind.values():
        assert sorted(kinds) == [0, 1, 2, 3]
        contents = [len(kinds[kind].request) + len(kinds[kind].response) for kind in range(4)]
        assert contents == [0, 1, 1, 0]  # the client tells only that something happened
    assert by_kind["send_goal"][1].request[0].goal.order == 7
    assert by_kind["send_goal"][2].response[0].accepted is True
    assert by_kind["cancel_goal"][1].request[0].goal_info.goal_id == goal.goal_id
    assert list(by_kind["get_result"][2].response[0].result.sequence) == [1, 2]


def test_events_are_switched_off(node, client, server, events, context, executor):
    configure(client, CONTENTS)
    configure(server, CONTENTS)
    assert context.wait_for_graph(lambda: publishers(node) == [2, 2, 2], 60_000_000_000)
    configure(client, OFF)
    configure(server, OFF)
    assert context.wait_for_graph(lambda: publishers(node) == [0, 0, 0], 60_000_000_000)
    assert client.wait_for_server(timeout_sec=60)
    send_and_cancel(client, server, executor)
    assert events == {name: [] for name in SERVICES}


def test_destroyed_ends_are_not_configured(client, server):
    for end in (client, server):
        end.destroy()
        with pytest.raises(InvalidHandle):
            configure(end, METADATA)
