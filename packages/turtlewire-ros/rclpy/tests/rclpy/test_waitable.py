"""Waitables that programs make."""

import pytest

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.clock import Clock
from rclpy.guard_condition import GuardCondition
from rclpy.timer import Timer
from rclpy.waitable import NumberOfEntities, Waitable
from std_msgs.msg import Int32


class Composed(Waitable):
    """Waits for a guard condition, a timer and a subscription, and says what came."""

    def __init__(self, node, group=None):
        super().__init__(group or node.default_callback_group)
        self.guard = GuardCondition(None, None, node.context)
        self.timer = Timer(None, None, 10_000_000, Clock(), context=node.context, autostart=False)
        self.subscription = node._rclpy_endpoints.make_subscription(
            Int32, "number", lambda _: None, 10, None
        )
        self.executed = []
        self.came = None

    def add_to_wait_set(self, wait_set):
        self.indexes = {
            "guard_condition": wait_set.add_guard_condition(self.guard),
            "timer": wait_set.add_timer(self.timer),
            "subscription": wait_set.add_subscription(self.subscription),
        }

    def get_num_entities(self):
        return NumberOfEntities(1, 1, 1)

    def is_ready(self, wait_set):
        ready = [kind for kind, index in self.indexes.items() if wait_set.is_ready(kind, index)]
        self.came = ready[0] if ready else None
        return bool(ready)

    def take_data(self):
        return self.subscription.take_message()[0].data if self.came == "subscription" else None

    async def execute(self, taken_data):
        self.executed.append((self.came, taken_data))


@pytest.fixture
def composed(node, executor):
    composed = Composed(node)
    node.add_waitable(composed)
    yield composed
    composed.destroy()


def test_each_part_makes_it_ready(node, composed, spin_until):
    composed.guard.trigger()
    spin_until(lambda: len(composed.executed) == 1)
    node.create_publisher(Int32, "number", 10).publish(Int32(data=5))
    spin_until(lambda: len(composed.executed) == 2)
    composed.timer.reset()
    spin_until(lambda: len(composed.executed) == 4)
    assert composed.executed == [
        ("guard_condition", None),
        ("subscription", 5),
        ("timer", None),
        ("timer", None),
    ]
    assert list(node.waitables) == [composed]


def test_waitables_come_before_the_other_entities(node, composed, executor):
    order = []
    node.create_guard_condition(lambda: order.append("guard")).trigger()
    composed.guard.trigger()
    executor.spin_once(timeout_sec=60)
    assert (order, len(composed.executed)) == ([], 1)
    executor.spin_once(timeout_sec=60)
    assert order == ["guard"]


def test_its_group_is_respected(node, executor):
    group = MutuallyExclusiveCallbackGroup()
    composed = Composed(node, group)
    node.add_waitable(composed)
    other = object()
    assert group.beginning_execution(other)
    composed.guard.trigger()
    executor.spin_once(timeout_sec=0)
    assert composed.executed == []
    group.ending_execution(other)
    executor._rclpy_scheduler.resume_paused()
    executor.spin_once(timeout_sec=60)
    assert composed.executed == [("guard_condition", None)]
    composed.destroy()


def test_a_removed_waitable_is_not_served(node, composed, executor):
    node.remove_waitable(composed)
    composed.guard.trigger()
    executor.spin_once(timeout_sec=0)
    assert composed.executed == []
    assert list(node.waitables) == []


def test_numbers_of_entities_add_up():
    total = NumberOfEntities(1, 2, 3, 4, 5, 6) + NumberOfEntities(1)
    total += NumberOfEntities(num_events=1)
    assert repr(total) == "<NumberOfEntities(2, 2, 3, 4, 5, 7)>"
