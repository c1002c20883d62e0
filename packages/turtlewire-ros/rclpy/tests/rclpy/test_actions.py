"""Action clients and servers, and the events of their services, on both middlewares."""

import pytest

import rclpy
from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from builtin_interfaces.msg import Time as TimeMsg
from example_interfaces.action import Fibonacci
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.action import (
    ActionClient,
    ActionServer,
    CancelResponse,
    GoalResponse,
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.action.client import ClientGoalHandle
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_action_status_default, qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from rclpy.task import Future
from std_msgs.msg import Int32
from unique_identifier_msgs.msg import UUID

pytestmark = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])


@pytest.fixture
def serve(node):
    """Makes the server of `fibonacci`."""
    servers = []

    def make(execute_callback, **arguments):
        servers.append(ActionServer(node, Fibonacci, "fibonacci", execute_callback, **arguments))
        return servers[-1]

    yield make
    for server in servers:
        server.destroy()


@pytest.fixture
def client(node):
    client = ActionClient(node, Fibonacci, "fibonacci")
    yield client
    client.destroy()


@pytest.fixture
def finish(executor):
    """Spins until a future is done, and gives its result."""

    def finish(future):
        executor.spin_until_future_complete(future, timeout_sec=60)
        assert future.done()
        return future.result()

    return finish


def count(goal_handle):
    sequence = list(range(goal_handle.request.order))
    for length in range(1, len(sequence)):
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence[:length]))
    goal_handle.succeed()
    return Fibonacci.Result(sequence=sequence)


def send(client, finish, order=3, **arguments):
    assert client.wait_for_server(timeout_sec=60)
    return finish(client.send_goal_async(Fibonacci.Goal(order=order), **arguments))


def test_a_goal_with_feedback_and_result(serve, client, finish, spin_until):
    serve(count)
    feedback = []
    handle = send(client, finish, order=4, feedback_callback=feedback.append)
    assert isinstance(handle, ClientGoalHandle)
    assert handle.accepted
    assert handle.stamp.sec > 0
    response = finish(handle.get_result_async())
    assert response.status == GoalStatus.STATUS_SUCCEEDED
    assert list(response.result.sequence) == [0, 1, 2, 3]
    assert handle.status == GoalStatus.STATUS_SUCCEEDED
    spin_until(lambda: len(feedback) == 3)
    assert [list(each.feedback.sequence) for each in feedback] == [[0], [0, 1], [0, 1, 2]]
    assert all(each.goal_id == handle.goal_id for each in feedback)
    assert repr(handle).startswith("ClientGoalHandle <id=")


def test_wait_for_server_raises_on_an_invalid_context(client, context):
    context.shutdown()
    text = "^Failed to check if action server is available: rcl node's context is invalid$"
    with pytest.raises(RCLError, match=text):
        client.wait_for_server(timeout_sec=1.0)
    with pytest.raises(RCLError, match=text):
        client.server_is_ready()


def test_a_given_goal_id_and_a_repeated_one(serve, client, finish):
    serve(count)
    goal_id = UUID(uuid=list(range(16)))
    handle = send(client, finish, goal_uuid=goal_id)
    assert handle.goal_id == goal_id
    finish(handle.get_result_async())
    again = send(client, finish, goal_uuid=goal_id)
    assert not again.accepted
    assert again == handle
    assert hash(again) == hash(handle)


def test_a_rejected_goal(serve, client, finish):
    serve(
        count,
        goal_callback=lambda goal: GoalResponse.REJECT if goal.order > 5 else GoalResponse.ACCEPT,
    )
    assert not send(client, finish, order=6, feedback_callback=print).accepted
    assert send(client, finish, order=5).accepted
    assert client._feedback_callbacks == {}


def test_of_two_goals_with_one_id_only_one_is_accepted(serve, client, finish, spin_until, capfd):
    gate, asked = Future(), []

    async def decide(goal):
        asked.append(goal)
        await gate
        return GoalResponse.ACCEPT

    server = serve(count, goal_callback=decide, callback_group=ReentrantCallbackGroup())
    goal_id = UUID(uuid=[5] * 16)
    assert client.wait_for_server(timeout_sec=60)
    sent = [client.send_goal_async(Fibonacci.Goal(), goal_uuid=goal_id) for _ in range(2)]
    spin_until(lambda: len(asked) == 2)
    gate.set_result(None)
    assert sorted(finish(future).accepted for future in sent) == [False, True]
    assert len(server._goals) == 1
    assert "]: Failed to accept new goal: goal ID already exists" in capfd.readouterr().err


def test_a_goal_callback_that_decides_nothing_rejects(serve, client, finish, capfd):
    serve(count, goal_callback=lambda goal: None)
    assert not send(client, finish).accepted
    assert (
        "Goal request callback did not return a GoalResponse type. Rejecting goal."
        in capfd.readouterr().err
    )


def test_async_decisions(serve, client, finish):
    async def accept(goal):
        return GoalResponse.ACCEPT

    async def agree(goal_handle):
        return CancelResponse.ACCEPT

    gate = Future()

    async def execute(goal_handle):
        result = Fibonacci.Result(sequence=[await gate])
        goal_handle.canceled()
        return result

    serve(execute, goal_callback=accept, cancel_callback=agree)
    handle = send(client, finish)
    assert len(finish(handle.cancel_goal_async()).goals_canceling) == 1
    answer = handle.get_result_async()
    gate.set_result(7)
    response = finish(answer)
    assert (response.status, list(response.result.sequence)) == (GoalStatus.STATUS_CANCELED, [7])


def test_without_an_outcome_a_goal_is_aborted_with_a_warning(serve, client, finish, capfd):
    serve(lambda goal_handle: Fibonacci.Result(sequence=[1]))
    response = finish(send(client, finish).get_result_async())
    assert response.status == GoalStatus.STATUS_ABORTED
    assert list(response.result.sequence) == [1]
    assert (
        "[tested.action_server]: Goal state not set, assuming aborted. Goal ID: ["
        in capfd.readouterr().err
    )


@pytest.mark.parametrize("asks", ["before", "after"])
@pytest.mark.parametrize(
    ("wrong", "described"),
    [(Fibonacci.Result, "the class Fibonacci_Result"), (3, "an object of type int")],
)
def test_a_result_of_a_wrong_type_is_logged_and_the_client_has_an_answer(
    serve, client, finish, capfd, asks, wrong, described
):
    gate = Future()

    async def execute(goal_handle):
        goal_handle.succeed()
        if asks == "before":
            await gate
        return wrong

    serve(execute)
    handle = send(client, finish)
    answer = handle.get_result_async()
    gate.set_result(None)
    response = finish(answer)
    assert (response.status, list(response.result.sequence)) == (GoalStatus.STATUS_SUCCEEDED, [])
    assert (
        "Error raised in execute callback: The execute callback of action 'fibonacci' has to "
        f"return a Fibonacci.Result; it returned {described}" in capfd.readouterr().err
    )


def test_an_exception_aborts_and_is_logged(serve, client, finish, capfd):
    serve(lambda goal_handle: 1 / 0)
    response = finish(send(client, finish).get_result_async())
    assert response.status == GoalStatus.STATUS_ABORTED
    assert "Error raised in execute callback: division by zero" in capfd.readouterr().err


def test_outcomes_can_be_reported_once(serve, client, finish):
    errors = []

    def execute(goal_handle):
        goal_handle.abort()
        for report in (goal_handle.succeed, goal_handle.abort, goal_handle.canceled):
            with pytest.raises(
                RCLError,
                match="goal_handle attempted invalid transition from state ABORTED with event",
            ) as caught:
                report()
            errors.append(caught.value)
        return Fibonacci.Result()

    serve(execute)
    assert finish(send(client, finish).get_result_async()).status == GoalStatus.STATUS_ABORTED
    assert len(errors) == 3


@pytest.fixture
def patient(serve):
    """A server whose goals wait to be cancelled or let go."""
    gate = Future()

    async def execute(goal_handle):
        await gate
        if goal_handle.is_cancel_requested:
            goal_handle.canceled()
        else:
            goal_handle.succeed()
        return Fibonacci.Result()

    def make(cancel_response, **arguments):
        return serve(execute, cancel_callback=lambda goal_handle: cancel_response, **arguments)

    make.gate = gate
    return make


def test_cancelling(patient, client, finish):
    patient(CancelResponse.ACCEPT)
    handle = send(client, finish)
    answer = finish(handle.cancel_goal_async())
    assert answer.return_code == CancelGoal.Response.ERROR_NONE
    assert [goal.goal_id for goal in answer.goals_canceling] == [handle.goal_id]
    patient.gate.set_result(None)
    assert finish(handle.get_result_async()).status == GoalStatus.STATUS_CANCELED
    assert (
        finish(handle.cancel_goal_async()).return_code == CancelGoal.Response.ERROR_GOAL_TERMINATED
    )


def test_a_refused_cancelling(patient, client, finish):
    patient(CancelResponse.REJECT)
    handle = send(client, finish)
    answer = finish(handle.cancel_goal_async())
    assert answer.goals_canceling == []
    assert answer.return_code == CancelGoal.Response.ERROR_NONE  # as rclpy's server answers
    patient.gate.set_result(None)
    assert finish(handle.get_result_async()).status == GoalStatus.STATUS_SUCCEEDED


def test_which_goals_a_cancel_request_means(patient, client, finish):
    patient(CancelResponse.ACCEPT)
    handles = [send(client, finish) for _ in range(3)]
    unknown = GoalInfo(goal_id=UUID(uuid=[9] * 16))
    answer = finish(client._cancel_client.call_async(CancelGoal.Request(goal_info=unknown)))
    assert (answer.return_code, answer.goals_canceling) == (
        CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID,
        [],
    )
    until_second = GoalInfo(stamp=handles[1].stamp)
    answer = finish(client._cancel_client.call_async(CancelGoal.Request(goal_info=until_second)))
    assert [goal.goal_id for goal in answer.goals_canceling] == [
        handle.goal_id for handle in handles[:2]
    ]
    long_ago_and_third = GoalInfo(stamp=TimeMsg(sec=1), goal_id=handles[2].goal_id)
    answer = finish(
        client._cancel_client.call_async(CancelGoal.Request(goal_info=long_ago_and_third))
    )
    assert [goal.goal_id for goal in answer.goals_canceling] == [handles[2].goal_id]
    answer = finish(client._cancel_client.call_async(CancelGoal.Request()))
    assert len(answer.goals_canceling) == 3
    patient.gate.set_result(None)


def test_a_goal_can_be_executed_later_or_be_cancelled_before(serve, client, finish, spin_until):
    accepted = []
    serve(
        count,
        handle_accepted_callback=accepted.append,
        cancel_callback=lambda _: CancelResponse.ACCEPT,
    )
    handle = send(client, finish)
    spin_until(lambda: accepted)
    assert isinstance(accepted[0], ServerGoalHandle)
    assert accepted[0].status == GoalStatus.STATUS_ACCEPTED
    assert accepted[0].is_active
    finish(handle.cancel_goal_async())
    assert accepted[0].is_cancel_requested
    accepted[0].execute(lambda goal_handle: (goal_handle.canceled(), Fibonacci.Result())[1])
    assert finish(handle.get_result_async()).status == GoalStatus.STATUS_CANCELED


def test_the_result_of_an_unknown_goal(serve, client, finish):
    serve(count)
    assert client.wait_for_server(timeout_sec=60)
    request = Fibonacci.Impl.GetResultService.Request(goal_id=UUID(uuid=[7] * 16))
    assert finish(client._result_client.call_async(request)).status == GoalStatus.STATUS_UNKNOWN


def test_results_are_forgotten_after_their_time(serve, client, finish, executor):
    server = serve(count, result_timeout=0.05)
    handle = send(client, finish)
    finish(handle.get_result_async())
    while server._goals:  # on a busy machine the time may be over by now
        executor.spin_once(timeout_sec=60)
    assert finish(handle.get_result_async()).status == GoalStatus.STATUS_UNKNOWN


def test_a_goal_that_is_destroyed_has_no_result_to_forget(serve, client, finish):
    handles = []
    server = serve(lambda goal_handle: (handles.append(goal_handle), count(goal_handle))[1])
    finish(send(client, finish).get_result_async())
    assert server._goals.first_end_ns() is not None
    handles[0].destroy()
    assert len(server._goals) == 0
    assert server._goals.first_end_ns() is None


def test_states_are_published_also_for_late_joiners(serve, client, finish, node, spin_until):
    serve(count)
    handle = send(client, finish)
    finish(handle.get_result_async())
    seen = []
    node.create_subscription(
        GoalStatusArray, "fibonacci/_action/status", seen.append, qos_profile_action_status_default
    )
    spin_until(lambda: seen)
    assert [state.status for state in seen[-1].status_list] == [GoalStatus.STATUS_SUCCEEDED]
    assert seen[-1].status_list[0].goal_info.goal_id == handle.goal_id
    assert seen[-1].status_list[0].goal_info.stamp == handle.stamp


def test_blocking_calls(pool, spinning, serve, client):
    serve(count)
    spinning(pool)
    assert client.wait_for_server(timeout_sec=60)
    response = client.send_goal(Fibonacci.Goal(order=3))
    assert list(response.result.sequence) == [0, 1, 2]


def test_a_server_that_would_do_nothing_says_so(node, capfd):
    server = ActionServer(node, Fibonacci, "fibonacci")
    assert (
        "Not handling nor executing the goal, this server will do nothing" in capfd.readouterr().err
    )
    server.destroy()


def test_execute_needs_an_execute_callback(serve, client, finish):
    serve(None, handle_accepted_callback=lambda goal_handle: goal_handle.execute())
    sent = client.send_goal_async(Fibonacci.Goal())
    text = r"^'ActionServer' object has no attribute '_execute_callback'"
    with pytest.raises(AttributeError, match=text) as raised:
        finish(sent)
    assert raised.value.hint.startswith("Pass execute_callback to ActionServer")


def test_wrong_types(serve, client, node):
    with pytest.raises(TypeError):
        client.send_goal_async(Fibonacci.Result())
    with pytest.raises(TypeError, match="Expected type ClientGoalHandle but received"):
        client._cancel_goal_async("goal")
    with pytest.raises(TypeError, match="not callable"):
        serve("count")
    with pytest.raises(AttributeError, match="_TYPE_SUPPORT"):
        ActionClient(node, int, "fibonacci")
    server = serve(count)
    with pytest.raises(TypeError):
        server._publish_feedback(UUID(), Int32())


def test_coming_and_going(serve, client, node, context):
    assert not client.server_is_ready()
    assert not client.wait_for_server(timeout_sec=0.05)
    assert not client.wait_for_server(timeout_sec=-0.5)
    server = serve(count)
    assert client.wait_for_server(timeout_sec=60)
    assert set(node.waitables) == {client, server}
    server.destroy()
    assert context.wait_for_graph(lambda: not client.server_is_ready(), 60_000_000_000)
    assert list(node.waitables) == [client]


def test_the_graph_knows_actions(serve, client, node, context):
    serve(count)
    expected = [("/fibonacci", ["example_interfaces/action/Fibonacci"])]
    assert context.wait_for_graph(
        lambda: get_action_names_and_types(node) == expected, 20_000_000_000
    )
    assert context.wait_for_graph(
        lambda: get_action_server_names_and_types_by_node(node, "tested", "/") == expected,
        20_000_000_000,
    )
    assert get_action_client_names_and_types_by_node(node, "tested", "/") == expected


def test_a_goal_can_be_executed_between_two_spins(context):
    accepted = []
    node = Node("between", context=context)
    server = ActionServer(
        node, Fibonacci, "fibonacci", count, handle_accepted_callback=accepted.append
    )
    client = ActionClient(node, Fibonacci, "fibonacci")
    with SingleThreadedExecutor(context=context) as executor:

        def finish(future):
            rclpy.spin_until_future_complete(node, future, executor, timeout_sec=60)
            return future.result()

        handle = send(client, finish)
        while not accepted:
            rclpy.spin_once(node, executor=executor, timeout_sec=60)
        assert executor.get_nodes() == []
        accepted[0].execute()
        assert finish(handle.get_result_async()).status == GoalStatus.STATUS_SUCCEEDED
    client.destroy()
    server.destroy()


def test_the_response_comes_before_the_feedback_that_waits_with_it(serve, executor, context):
    """The client's node is spun when the server has answered and sent feedback."""
    served = []
    serve(lambda goal_handle: (count(goal_handle), served.append(goal_handle))[0])
    elsewhere = Node("client", context=context)
    client = ActionClient(elsewhere, Fibonacci, "fibonacci")
    assert client.wait_for_server(timeout_sec=60)
    accepted = []
    future = client.send_goal_async(
        Fibonacci.Goal(order=3), feedback_callback=lambda _: accepted.append(future.done())
    )
    while not served:  # a writer hands over to the readers of its own process at once
        executor.spin_once(timeout_sec=60)
    with SingleThreadedExecutor(context=context) as late:
        late.add_node(elsewhere)
        while len(accepted) < 2:
            late.spin_once(timeout_sec=60)
    assert accepted == [True, True]
    client.destroy()


def test_the_feedback_that_waits_with_the_result_comes_before_it(serve, executor, context):
    gate, served = Future(), []

    async def execute(goal_handle):
        await gate
        goal_handle.publish_feedback(Fibonacci.Feedback(sequence=[1]))
        goal_handle.succeed()
        served.append(goal_handle)
        return Fibonacci.Result()

    server = serve(execute)
    elsewhere = Node("client", context=context)
    client = ActionClient(elsewhere, Fibonacci, "fibonacci")
    finished = []
    with SingleThreadedExecutor(context=context) as late:
        late.add_node(elsewhere)
        assert client.wait_for_server(timeout_sec=60)
        sent = client.send_goal_async(
            Fibonacci.Goal(order=3), feedback_callback=lambda _: finished.append(result.done())
        )
        while not sent.done():
            executor.spin_once(timeout_sec=0.1)
            late.spin_once(timeout_sec=0.1)
        result = sent.result().get_result_async()
        ((goal, _),) = server._goals.all()
        while not goal.result._callbacks:  # the server has got the request for the result
            executor.spin_once(timeout_sec=60)
        gate.set_result(None)
        while not goal.result.done():
            executor.spin_once(timeout_sec=60)
        executor.spin_once(timeout_sec=0)
        late.spin_until_future_complete(result, timeout_sec=60)
    assert finished == [False]
    client.destroy()


def test_no_feedback_that_was_sent_after_the_result(serve, client, finish, spin_until):
    goals, feedback = [], []
    serve(lambda goal_handle: (goals.append(goal_handle), count(goal_handle))[1])
    handle = send(client, finish, order=3, feedback_callback=feedback.append)
    finish(handle.get_result_async())
    spin_until(lambda: len(feedback) == 2)
    goals[0].publish_feedback(Fibonacci.Feedback(sequence=[7]))
    other = []
    second = send(client, finish, order=2, feedback_callback=other.append)
    finish(second.get_result_async())
    spin_until(lambda: other)  # it was sent after the one that must not come
    assert [list(each.feedback.sequence) for each in feedback] == [[0], [0, 1]]


def test_the_callback_of_a_goal_whose_result_is_not_wanted_is_forgotten(
    serve, client, finish, spin_until, monkeypatch
):
    monkeypatch.setattr("rclpy.action.client._FINISHED_GOALS", 0)
    serve(count)
    feedback = []
    send(client, finish, order=3, feedback_callback=feedback.append)
    spin_until(lambda: client._feedback_callbacks == {})
    assert client._finished_ns == {}


def test_callbacks_of_the_last_finished_goals_are_kept_for_late_feedback(
    serve, client, finish, monkeypatch
):
    monkeypatch.setattr("rclpy.action.client._FINISHED_GOALS", 2)
    serve(count)
    keys = []
    for kept in (1, 2, 2):
        handle = send(client, finish, order=0, feedback_callback=print)
        keys.append(bytes(handle.goal_id.uuid))
        finish(handle.get_result_async())
        assert list(client._feedback_callbacks) == keys[-kept:]


# Introspection

SERVICES = {
    "send_goal": Fibonacci.Impl.SendGoalService,
    "cancel_goal": Fibonacci.Impl.CancelGoalService,
    "get_result": Fibonacci.Impl.GetResultService,
}
CONTENTS = ServiceIntrospectionState.CONTENTS
METADATA = ServiceIntrospectionState.METADATA
OFF = ServiceIntrospectionState.OFF


@pytest.fixture
def server(serve):
    return serve(
        lambda _: Fibonacci.Result(),
        handle_accepted_callback=lambda _: None,  # the test executes it
        cancel_callback=lambda _: CancelResponse.ACCEPT,
    )


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


def send_and_cancel(client, server, finish):
    """Send a goal, cancel it, and get its result."""
    handles = []
    server.register_handle_accepted_callback(handles.append)
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


def test_events_of_an_action(node, client, server, events, context, finish, spin_until):
    configure(client, METADATA)
    configure(server, CONTENTS)
    assert client.wait_for_server(timeout_sec=60)
    assert context.wait_for_graph(
        lambda: publishers(node) == [2, 2, 2] and matched(client, server), 60_000_000_000
    )
    goal = send_and_cancel(client, server, finish)
    spin_until(lambda: [len(each) for each in events.values()] == [4, 4, 4])
    by_kind = {
        name: {event.info.event_type: event for event in each} for name, each in events.items()
    }
    for kinds in by_kind.values():
        assert sorted(kinds) == [0, 1, 2, 3]
        contents = [len(kinds[kind].request) + len(kinds[kind].response) for kind in range(4)]
        assert contents == [0, 1, 1, 0]  # the client tells only that something happened
        assert len({bytes(event.info.client_gid) for event in kinds.values()}) == 1
        assert len({event.info.sequence_number for event in kinds.values()}) == 1
    assert by_kind["send_goal"][1].request[0].goal.order == 7
    assert by_kind["send_goal"][2].response[0].accepted is True
    assert by_kind["cancel_goal"][1].request[0].goal_info.goal_id == goal.goal_id
    assert list(by_kind["get_result"][2].response[0].result.sequence) == [1, 2]


def test_events_are_switched_off(node, client, server, events, context, finish):
    configure(client, CONTENTS)
    configure(server, CONTENTS)
    assert context.wait_for_graph(lambda: publishers(node) == [2, 2, 2], 60_000_000_000)
    configure(client, OFF)
    configure(server, OFF)
    assert context.wait_for_graph(lambda: publishers(node) == [0, 0, 0], 60_000_000_000)
    assert client.wait_for_server(timeout_sec=60)
    send_and_cancel(client, server, finish)
    assert events == {name: [] for name in SERVICES}


def test_destroyed_ends_are_not_configured(client, server):
    for end in (client, server):
        end.destroy()
        with pytest.raises(InvalidHandle):
            configure(end, METADATA)
