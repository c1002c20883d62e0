"""Messages that the wire's threads handle: they end a ``spin_once``, and do not wake a ``spin``."""

import threading

import pytest

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

pytestmark = pytest.mark.parametrize("middleware", ["local", "rmw_cyclonedds_cpp"])

LIMIT_S = 60


@pytest.fixture
def listener(context, node):
    listener = TransformListener(Buffer(), node)
    yield listener
    listener.destroy()


def transform(parent, child, sec=0):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp.sec = sec
    message.transform.rotation.w = 1.0
    return message


class Talker:
    """Publishes transforms from another node, by its own thread."""

    def __init__(self, context):
        self.node = Node("talker", context=context)
        self.broadcaster = TransformBroadcaster(self.node)
        self.static_broadcaster = StaticTransformBroadcaster(self.node)

    def wait_for_listener(self):
        assert self.node.wait_for_node("/tested", LIMIT_S)
        publisher = self.broadcaster.pub_tf
        assert publisher._context.wait_for_graph(
            lambda: publisher.get_subscription_count() > 0, LIMIT_S * 10**9
        )


@pytest.fixture
def talker(context):
    talker = Talker(context)
    yield talker
    talker.node.destroy_node()


def finishes(call):
    """Whether ``call()`` returns; the thread is a daemon in case it does not."""
    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(LIMIT_S)
    return not thread.is_alive()


def test_a_loop_of_spin_once_ends_when_only_transforms_arrive(listener, talker, executor, node):
    def wait_for_transform():
        while not listener.buffer.can_transform("world", "robot", rclpy.time.Time()):
            executor.spin_once()

    talker.static_broadcaster.sendTransform(transform("world", "robot"))
    assert finishes(wait_for_transform)


def test_messages_without_news_count_too_and_each_arrival_once(listener, talker, executor):
    talker.wait_for_listener()
    came = threading.Event()
    rounds = []

    def send():
        while not came.is_set():
            talker.broadcaster.sendTransform(transform("world", "robot", sec=1))
            came.wait(0.01)

    def spin():
        for _ in range(5):
            executor.spin_once()
            rounds.append(1)

    sender = threading.Thread(target=send)
    sender.start()
    try:
        assert finishes(spin), f"only {len(rounds)} of 5 spins returned"
    finally:
        came.set()
        sender.join()
    while listener._engine.take_arrivals():
        pass
    assert not listener._engine.expect_message()


def test_spin_is_not_woken(listener, talker, executor, node, spinning):
    talker.wait_for_listener()
    waits = []
    wait = executor._rclpy_scheduler.wait.wait
    executor._rclpy_scheduler.wait.wait = lambda timeout: (waits.append(1), wait(timeout))[1]
    done = threading.Event()
    node.create_guard_condition(done.set).trigger()
    spinning(executor)
    assert done.wait(LIMIT_S)
    before = len(waits)
    for second in range(1, 201):
        talker.broadcaster.sendTransform(transform("world", "robot", sec=second))
    assert listener.buffer.can_transform(
        "world", "robot", rclpy.time.Time(seconds=200), rclpy.duration.Duration(seconds=LIMIT_S)
    )
    assert len(waits) - before < 5


def test_another_executor_of_one_process_is_told_as_well(listener, talker, context):
    other = Node("other", context=context)
    second = TransformListener(Buffer(), other)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(other)
    talker.static_broadcaster.sendTransform(transform("world", "robot"))

    def wait_for_transform():
        while not second.buffer.can_transform("world", "robot", rclpy.time.Time()):
            executor.spin_once()

    assert finishes(wait_for_transform)
    executor.shutdown()
