"""Messages of several inputs in the order of their stamps."""

import pytest

from geometry_msgs.msg import PointStamped
from message_filters import SimpleFilter
from message_filters.input_aligner import InputAligner, QueueStatus
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time


def at(seconds):
    message = PointStamped()
    message.header.stamp = Time(seconds=seconds).to_msg()
    return message


class Aligned:
    """An aligner of two inputs, and what it has passed on."""

    def __init__(self, timeout=10.0):
        self.inputs = [SimpleFilter(), SimpleFilter()]
        self.aligner = InputAligner(timeout, self.inputs)
        self.heard = []
        for index, letter in enumerate("ab"):
            self.aligner.registerCallback(index, self._hear, letter)

    def _hear(self, message, letter):
        self.heard.append((letter, message.header.stamp.sec))

    def give(self, letter, *seconds):
        for each in seconds:
            self.inputs["ab".index(letter)].signalMessage(at(each))

    def dispatched(self):
        self.aligner.dispatchMessages()
        heard, self.heard[:] = list(self.heard), []
        return heard


def test_messages_are_passed_on_by_stamp():
    aligned = Aligned()
    aligned.give("a", 3, 1, 5)
    aligned.give("b", 2, 4)
    assert aligned.heard == []
    # 5 waits: b may have another message before it
    assert aligned.dispatched() == [("a", 1), ("b", 2), ("a", 3), ("b", 4)]
    aligned.give("b", 6)
    assert aligned.dispatched() == [("a", 5)]


def test_an_input_without_messages_holds_nothing_up():
    aligned = Aligned()
    aligned.give("a", 1, 2)
    assert aligned.dispatched() == [("a", 1), ("a", 2)]
    assert aligned.aligner.getQueueStatus(1) == QueueStatus(False, 0, 0, 0)


def test_after_the_timeout_nothing_waits():
    aligned = Aligned(timeout=Duration(seconds=2))
    aligned.give("b", 1)
    aligned.give("a", 2, 4)
    assert aligned.dispatched() == [("b", 1)]  # 4 is not more than two seconds later than 2
    aligned.give("a", 5)
    # without b, which is no longer waited for
    assert aligned.dispatched() == [("a", 2), ("a", 4), ("a", 5)]
    assert aligned.aligner.getQueueStatus(1).active is False
    aligned.give("b", 6)
    assert aligned.aligner.getQueueStatus(1).active is True


def test_messages_that_come_too_late_are_dropped_and_counted():
    aligned = Aligned()
    aligned.give("a", 5)
    assert aligned.dispatched() == [("a", 5)]
    aligned.give("b", 4, 5, 6)
    assert aligned.aligner.getQueueStatus(1) == QueueStatus(True, 2, 0, 1)
    aligned.give("a", 7)
    assert aligned.dispatched() == [("b", 5), ("b", 6)]
    assert aligned.aligner.getQueueStatus(1) == QueueStatus(True, 0, 2, 1)
    assert aligned.aligner.getQueueStatus(0) == QueueStatus(True, 1, 1, 0)


def test_a_period_says_when_the_next_message_is_due():
    aligned = Aligned()
    aligned.aligner.setInputPeriod(1, 10.0)
    aligned.give("b", 1)
    aligned.give("a", 2, 10, 11)
    # the next of b is due at 11
    assert aligned.dispatched() == [("b", 1), ("a", 2), ("a", 10)]
    aligned.give("b", 12)
    assert aligned.dispatched() == [("a", 11)]


def test_a_timer_of_a_node_passes_messages_on(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    aligned = Aligned()
    with Context() as context, SingleThreadedExecutor(context=context) as executor:
        node = Node("aligned", context=context)
        executor.add_node(node)
        with pytest.raises(ValueError, match="must be above 0, not 0"):
            aligned.aligner.setupDispatchTimer(node, 0.0)
        aligned.aligner.setupDispatchTimer(node, 100.0)
        aligned.aligner.setupDispatchTimer(node, Duration(nanoseconds=1_000_000))
        assert len(list(node.timers)) == 1
        aligned.give("a", 1)
        executor.spin_once(timeout_sec=60)
        assert aligned.heard == [("a", 1)]


def test_disconnected_filters_are_not_heard():
    aligned = Aligned()
    aligned.aligner.disconnectAll()
    aligned.give("a", 1)
    assert aligned.dispatched() == []
    aligned.aligner.connectInput(aligned.inputs[::-1])
    aligned.give("a", 1)
    assert aligned.dispatched() == [("b", 1)]


def test_name_and_indices():
    aligner = InputAligner(1.0)
    assert aligner.getName() == ""
    aligner.setName("scans")
    assert aligner.getName() == "scans"
    for call in (
        lambda: aligner.registerCallback(-1, print),
        lambda: aligner.setInputPeriod(-1, 1.0),
        lambda: aligner.add(at(1), -1),
        lambda: aligner.getQueueStatus(-1),
    ):
        with pytest.raises(IndexError, match="no input -1"):
            call()
