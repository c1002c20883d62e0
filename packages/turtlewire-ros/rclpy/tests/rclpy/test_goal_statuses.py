"""Goal states are read and written as bytes just as the general codec does it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.programs import run_python

from action_msgs.msg import GoalInfo, GoalStatus, GoalStatusArray
from builtin_interfaces.msg import Time
from rclpy.action._goal_statuses import GoalStatuses, read_statuses
from turtlewire.errors import CdrError
from turtlewire.msg import deserialize, serialize
from unique_identifier_msgs.msg import UUID

IDS = st.binary(min_size=16, max_size=16)
STATES = st.integers(1, 6)
#: Few different bytes, so that an id is also found by chance across the records of others.
SIMILAR_IDS = st.lists(st.sampled_from([0, 1]), min_size=16, max_size=16).map(bytes)


def message_of(goals: dict[bytes, int]) -> GoalStatusArray:
    return GoalStatusArray(
        status_list=[
            GoalStatus(
                goal_info=GoalInfo(goal_id=UUID(uuid=goal), stamp=Time(sec=1, nanosec=256)),
                status=status,
            )
            for goal, status in goals.items()
        ]
    )


@given(
    st.dictionaries(IDS, st.tuples(st.integers(0, 2**31 - 1), st.integers(0, 999_999_999))),
    st.data(),
)
def test_states_are_published_as_the_codec_would(stamps, data):
    statuses, expected = GoalStatuses(), {}
    for goal, (sec, nanosec) in stamps.items():
        statuses.add(goal, sec, nanosec, 1)
        info = GoalInfo(goal_id=UUID(uuid=goal), stamp=Time(sec=sec, nanosec=nanosec))
        expected[goal] = GoalStatus(goal_info=info, status=1)
    some = st.sampled_from(sorted(stamps)) if stamps else IDS
    for goal, status in data.draw(st.lists(st.tuples(some, STATES))):
        statuses.change(goal, status)
        if goal in expected:
            expected[goal].status = status
    gone = data.draw(st.lists(some))
    statuses.remove(gone)
    kept = [state for goal, state in expected.items() if goal not in gone]
    assert statuses.cdr() == serialize(GoalStatusArray(status_list=kept))


def test_the_state_of_a_goal_that_was_removed_is_not_kept():
    statuses = GoalStatuses()
    statuses.add(bytes(16), 1, 2, 1)
    statuses.remove([bytes(16)])
    statuses.change(bytes(16), 4)
    assert deserialize(GoalStatusArray, statuses.cdr()) == GoalStatusArray()


@given(st.dictionaries(SIMILAR_IDS, STATES), st.sets(SIMILAR_IDS, max_size=40), st.integers(0, 3))
def test_states_are_read_as_by_the_codec(states, others, padding):
    cdr = serialize(message_of(states))
    cdr += bytes(min(padding, -len(cdr) % 4))
    wanted = [goal for number, goal in enumerate(states) if number % 2] + sorted(others)
    expected = {goal: status for goal, status in states.items() if goal in wanted}
    assert dict(read_statuses(cdr, wanted)) == expected


def test_states_of_a_big_endian_server_are_read():
    cdr = bytes([0, 0, 0, 0, 0, 0, 0, 1, *range(16), 0, 0, 0, 1, 0, 0, 0, 2, 4])
    assert read_statuses(cdr, [bytes(range(16))]) == [(bytes(range(16)), 4)]


@pytest.mark.parametrize("cdr", [b"", b"\0\1\0\0", b"\0\1\0\0\2\0\0\0" + bytes(28)])
def test_malformed_states_are_refused(cdr):
    with pytest.raises(CdrError):
        read_statuses(cdr, [bytes(16)])


def test_a_goal_needs_no_numpy():
    program = """
import sys
import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer

def execute(goal_handle):
    goal_handle.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
    goal_handle.succeed()
    return Fibonacci.Result(sequence=[0, 1, 1])

rclpy.init(args=[])
node = rclpy.create_node("both")
server = ActionServer(node, Fibonacci, "fibonacci", execute)
client = ActionClient(node, Fibonacci, "fibonacci")
assert client.wait_for_server()
feedback = []
goal = client.send_goal_async(Fibonacci.Goal(order=3), feedback.append)
rclpy.spin_until_future_complete(node, goal)
result = goal.result().get_result_async()
rclpy.spin_until_future_complete(node, result)
while goal.result().status != 4 or not feedback:
    rclpy.spin_once(node)
print(list(result.result().result.sequence), "numpy" in sys.modules)
print(type(goal.result().goal_id.uuid).__name__)
rclpy.shutdown()
"""
    done = run_python(program, timeout=300)
    assert done.stdout == "[0, 1, 1] False\nndarray\n"
