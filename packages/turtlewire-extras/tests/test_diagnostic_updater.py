"""The status of a node on /diagnostics."""

import pytest

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from diagnostic_updater import (
    CompositeDiagnosticTask,
    DiagnosedPublisher,
    DiagnosticStatusWrapper,
    DiagnosticTask,
    FrequencyStatus,
    FrequencyStatusParam,
    FunctionDiagnosticTask,
    HeaderlessTopicDiagnostic,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
    TopicDiagnostic,
    Updater,
)
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Header

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class StillClock:
    """A clock that a test sets."""

    def __init__(self):
        self.seconds = 100.0

    def now(self):
        return Time(nanoseconds=round(self.seconds * 1e9))


def values(status):
    return {each.key: each.value for each in status.values}


@pytest.fixture
def node(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with Context() as context:
        node = Node("driver", namespace="/robot", context=context)
        yield node
        node.destroy_node()


@pytest.fixture
def got(node):
    """What arrives on /diagnostics, handled by `spin`."""
    statuses = []
    node.create_subscription(
        DiagnosticArray, "/diagnostics", lambda array: statuses.extend(array.status), 100
    )
    return statuses


def spin(node, is_done):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    while not is_done():
        executor.spin_once(timeout_sec=60)
    executor.shutdown()


@pytest.mark.parametrize(
    ("first", "second", "merged"),
    [
        ((OK, "a"), (OK, "b"), (OK, "a; b")),
        ((OK, "a"), (WARN, "b"), (WARN, "b")),
        ((WARN, "a"), (OK, "b"), (WARN, "a")),
        ((WARN, "a"), (ERROR, "b"), (ERROR, "a; b")),
        ((OK, ""), (OK, "b"), (OK, "b")),
    ],
)
def test_summaries_are_merged(first, second, merged):
    status = DiagnosticStatusWrapper()
    status.summary(*first)
    other = DiagnosticStatusWrapper()
    other.summary(*second)
    status.mergeSummary(other)
    assert (status.level, status.message) == merged
    status.summary(*first)
    status.mergeSummary(*second)
    assert (status.level, status.message) == merged
    status.clearSummary()
    assert (status.level, status.message) == (OK, "")


def test_a_composite_task_has_one_summary_and_all_values():
    def worn(status):
        status.summary(WARN, "worn")
        status.add("hours", 3)
        return status

    both = CompositeDiagnosticTask("both")
    both.addTask(Heartbeat())
    both.addTask(FunctionDiagnosticTask("wear", worn))
    status = both.run(DiagnosticStatusWrapper())
    assert (status.level, status.message, values(status)) == (WARN, "worn", {"hours": "3"})
    assert both.getName() == "both"


def test_a_node_publishes_its_tasks(node, got):
    updater = Updater(node, period=0.01)
    updater.setHardwareID("arm-7")

    def temperature(status):
        status.summary(WARN, "hot")
        status.add("degrees", 71.5)
        return status

    updater.add("temperature", temperature)
    updater.add(Heartbeat())
    spin(node, lambda: any(status.message == "Alive" for status in got))
    hot = next(status for status in got if status.message == "hot")
    assert (hot.level, hot.name, hot.hardware_id) == (WARN, "driver: temperature", "arm-7")
    assert values(hot) == {"degrees": "71.5"}
    # Each task is announced when it is added.
    assert (got[0].name, got[0].message) == ("driver: temperature", "Node starting up")
    assert updater.removeByName("temperature")
    assert not updater.removeByName("temperature")
    got.clear()
    updater.broadcast(ERROR, "off")
    spin(node, lambda: any(status.message == "off" for status in got))
    # An older status may arrive after the list was cleared.
    off = {status.name for status in got if status.message == "off"}
    assert off == {"driver: Heartbeat"}
    with pytest.raises(TypeError, match="expected a task, or a name and a function"):
        updater.add("name alone")


def test_parameters_set_period_and_names(monkeypatch, got, node):
    node.declare_parameter("diagnostic_updater.period", 0.02)
    node.declare_parameter("diagnostic_updater.use_fqn", True)
    updater = Updater(node)
    assert updater.period == 0.02
    updater.add(DiagnosticTaskThatSaysNothing("silent"))
    updater.force_update()
    spin(node, lambda: len(got) >= 2)
    assert got[1].name == "/robot/driver: silent"
    assert (got[1].level, got[1].message) == (ERROR, "No message was set")


class DiagnosticTaskThatSaysNothing(DiagnosticTask):
    def run(self, stat):
        return stat


@pytest.mark.parametrize(
    ("events", "bounds", "level", "message"),
    [
        (0, (1, 2), ERROR, "No events recorded."),
        (8, (10, 12), WARN, "Frequency too low."),
        (9, (10, 12), OK, "Desired frequency met"),
        (13, (10, 12), OK, "Desired frequency met"),
        (14, (10, 12), WARN, "Frequency too high."),
    ],
)
def test_frequencies(events, bounds, level, message):
    clock = StillClock()
    params = FrequencyStatusParam({"min": bounds[0], "max": bounds[1]}, tolerance=0.1)
    task = FrequencyStatus(params, clock=clock)
    for _ in range(events):
        task.tick()
    clock.seconds += 1
    status = task.run(DiagnosticStatusWrapper())
    assert (status.level, status.message) == (level, message)
    assert values(status)["Events in window"] == str(events)
    assert values(status)["Actual frequency (Hz)"] == f"{events:f}"
    assert ("Target frequency (Hz)" in values(status)) is False
    task.clear()
    assert task.run(DiagnosticStatusWrapper()).message == "No events recorded."


def test_a_window_of_runs_forgets_older_events():
    clock = StillClock()
    task = FrequencyStatus(FrequencyStatusParam({"min": 5, "max": 5}, 0, 2), clock=clock)
    for ticks in (100, 5, 5):
        for _ in range(ticks):
            task.tick()
        clock.seconds += 1
        status = task.run(DiagnosticStatusWrapper())
    assert status.message == "Desired frequency met"
    assert values(status)["Target frequency (Hz)"] == "5.000000"
    assert values(status)["Events since startup"] == "110"


@pytest.mark.parametrize(
    ("stamps", "level", "message"),
    [
        ([], WARN, "No data since last update."),
        ([99.0, 101.0, 95.0], OK, "Timestamps are reasonable."),
        ([101.1], ERROR, "Timestamps too far in future seen."),
        ([94.9], ERROR, "Timestamps too far in past seen."),
        ([0], ERROR, "Zero timestamp seen."),
        ([Time(seconds=99)], OK, "Timestamps are reasonable."),
        ([Time(seconds=94).to_msg()], ERROR, "Timestamps too far in past seen."),
    ],
)
def test_stamps(stamps, level, message):
    task = TimeStampStatus(clock=StillClock())
    for stamp in stamps:
        task.tick(stamp)
    status = task.run(DiagnosticStatusWrapper())
    assert (status.level, status.message) == (level, message)
    assert task.run(DiagnosticStatusWrapper()).message == "No data since last update."


def test_topics_are_watched(node):
    updater = Updater(node)
    frequency = FrequencyStatusParam({"min": 0, "max": float("inf")})
    stamps = TimeStampStatusParam(-1, 5)
    plain = HeaderlessTopicDiagnostic("plain", updater, frequency)
    plain.tick()
    topic = TopicDiagnostic("topic", updater, frequency, stamps)
    topic.tick(0)
    publisher = DiagnosedPublisher(
        node.create_publisher(Header, "heads", 1), updater, frequency, stamps
    )

    class Stamped:
        header = Header(stamp=node.get_clock().now().to_msg())

    publisher.publisher = type("Keeps", (), {"publish": lambda self, message: None})()
    publisher.publish(Stamped())
    told = {}
    for task in updater.tasks:
        status = task.run(DiagnosticStatusWrapper())
        told[task.name] = (status.level, status.message)
    assert told == {
        "plain topic status": (OK, "Desired frequency met"),
        "topic topic status": (ERROR, "Zero timestamp seen."),
        "/robot/heads topic status": (OK, "Desired frequency met; Timestamps are reasonable."),
    }
    plain.clear_window()
    assert plain.run(DiagnosticStatusWrapper()).level == ERROR
