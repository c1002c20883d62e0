"""Threads that make and destroy everything at once, while executors come and go."""

import itertools
import random
import threading

import pytest

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from rclpy.action import ActionClient, ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32
from tf2_ros import Buffer, TransformListener

LIMIT_S = 120
EXECUTORS, CHANGES = 200, 1500
MOST_KEPT = 12


class Churn:
    """Makes something with a node that others use, too, or destroys something made before."""

    def __init__(self, nodes, seed):
        self._nodes = nodes
        self._random = random.Random(seed)
        self._names = (f"passing_{seed}_{number}" for number in itertools.count())
        self._made = []
        self._makers = [
            self._subscription,
            self._publisher,
            self._timer,
            self._service,
            self._client,
            self._guard_condition,
            self._action_server,
            self._action_client,
            self._listener,
            self._node,
        ]

    def change(self):
        maker = self._random.choice(self._makers)
        group = self._random.choice(
            [None, MutuallyExclusiveCallbackGroup(), ReentrantCallbackGroup()]
        )
        self._made.append(maker(self._random.choice(self._nodes), group))
        while len(self._made) > self._random.randint(0, MOST_KEPT):
            self._made.pop(self._random.randrange(len(self._made)))()

    def end(self):
        while self._made:
            self._made.pop()()

    def _subscription(self, node, group):
        made = node.create_subscription(Int32, "topic", lambda _: None, 5, callback_group=group)
        return lambda: node.destroy_subscription(made)

    def _publisher(self, node, _):
        made = node.create_publisher(Int32, "topic", 5)
        for number in range(10):
            made.publish(Int32(data=number))
        return lambda: node.destroy_publisher(made)

    def _timer(self, node, group):
        made = node.create_timer(0.001, lambda: None, callback_group=group)
        return lambda: node.destroy_timer(made)

    def _service(self, node, group):
        made = node.create_service(AddTwoInts, "add", lambda _, r: r, callback_group=group)
        return lambda: node.destroy_service(made)

    def _client(self, node, group):
        made = node.create_client(AddTwoInts, "add", callback_group=group)
        for _ in range(5):
            made.call_async(AddTwoInts.Request())
        return lambda: node.destroy_client(made)

    def _guard_condition(self, node, group):
        made = node.create_guard_condition(lambda: None, callback_group=group)
        made.trigger()
        return lambda: node.destroy_guard_condition(made)

    def _action_server(self, node, group):
        def execute(goal):
            goal.succeed()
            return Fibonacci.Result()

        return ActionServer(node, Fibonacci, "count", execute, callback_group=group).destroy

    def _action_client(self, node, group):
        made = ActionClient(node, Fibonacci, "count", callback_group=group)
        made.send_goal_async(Fibonacci.Goal(order=2))
        return made.destroy

    def _listener(self, node, _):
        return TransformListener(Buffer(), node).unregister

    def _node(self, node, _):
        return Node(next(self._names), context=node.context).destroy_node


def spin_for_a_while(context, nodes, seed):
    """Have an executor after the other serve some of the nodes, and take one out meanwhile."""
    chance = random.Random(seed)
    for _ in range(EXECUTORS):
        threads = chance.choice([1, 2, 4])
        executor = (
            SingleThreadedExecutor(context=context)
            if threads == 1
            else MultiThreadedExecutor(threads, context=context)
        )
        for node in chance.sample(nodes, chance.randint(1, len(nodes))):
            executor.add_node(node)
        failures = []
        spinning = threading.Thread(target=noting, args=(failures, executor.spin))
        spinning.start()
        for _ in range(chance.randint(0, 5)):
            executor.create_task(lambda: None)
        executor.remove_node(chance.choice(nodes))
        assert executor.shutdown(LIMIT_S)
        spinning.join(LIMIT_S)
        assert not spinning.is_alive()
        assert failures == []


def churn(nodes, seed):
    made = Churn(nodes, seed)
    for _ in range(CHANGES):
        made.change()
    made.end()


def noting(failures, call, *arguments):
    try:
        call(*arguments)
    except BaseException as failure:
        failures.append(failure)


@pytest.mark.slow
@pytest.mark.timeout(600)
@pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp", "rmw_zenoh_cpp"])
def test_everything_comes_and_goes_in_several_threads(monkeypatch, middleware):
    monkeypatch.setenv("RMW_IMPLEMENTATION", middleware)
    failures = []
    with Context() as context:
        nodes = [Node(f"shared{number}", context=context) for number in range(4)]
        work = [(spin_for_a_while, context, nodes, seed) for seed in (1, 2)]
        work += [(churn, nodes, seed) for seed in (3, 4, 5)]
        threads = [threading.Thread(target=noting, args=(failures, *each)) for each in work]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for node in nodes:
            node.destroy_node()
    assert failures == []
