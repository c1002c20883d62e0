"""The wire as a source: its publishers, and the history that a page can go back to.

A parameter of a node: its text, or why there is none.
"""

import contextlib
import queue
import threading

import pytest

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from std_srvs.srv import Empty
from turtlewire import Buffer, msg
from turtlewire.errors import WireError
from turtlewire.tf.tf_topics import TfTopics
from turtlewire.wire.base import TypeId
from turtlewire.wire.qos import Durability, QoS
from turtlewire_view import LiveSource
from turtlewire_view.live import LiveTimeline
from turtlewire_view.source import ParameterAnswer

LATCHED = Durability.TRANSIENT_LOCAL
SECOND = 10**9
#: Stamps from here on are system time, earlier ones are of a simulation.
WALL_NS = 10**18


class History:
    """A source with ten seconds of history."""

    history_ns = 10 * SECOND

    def __init__(self, *stamps_ns):
        self.buffer = Buffer(None)
        self.add(*stamps_ns)

    def add(self, *stamps_ns):
        for stamp_ns in stamps_ns:
            self.buffer.set_transform("map", "base", stamp_ns, (0.0, 0.0, 0.0))


@pytest.fixture
def source(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    with contextlib.closing(LiveSource()) as source:
        yield source


def test_the_publisher_used_longest_ago_ends_for_the_seventeenth(source):
    def published():
        ends = source._context.graph.endpoints()
        return {end.topic for end in ends if end.kind == "publisher" and end.topic != "/rosout"}

    topics = [f"/topic{number}" for number in range(16)]
    for topic in [*topics, "/topic0"]:
        assert source.publish(topic, "std_msgs/msg/Empty", b"\0\1\0\0\0") == 0
    assert published() == {*topics}
    source.publish("/another", "std_msgs/msg/Empty", b"\0\1\0\0\0")
    assert published() == {*topics, "/another"} - {"/topic1"}


def test_a_subscription_that_cannot_be_replaced_is_named_and_tried_again(source, monkeypatch):
    def fail(*_):
        raise WireError("out of resources")

    heard, changed = queue.SimpleQueue(), queue.SimpleQueue()
    source.subscribe("/chatter", "std_msgs/msg/Empty", heard.put)
    source.on_change(lambda: changed.put(source.problem))
    empty = TypeId("std_msgs/msg/Empty", msg.type_hash("std_msgs/msg/Empty"))
    with monkeypatch.context() as full:
        full.setattr(source._node, "create_subscription", fail)
        publisher = source._node.create_publisher("/chatter", empty, QoS(durability=LATCHED))
        while changed.get(timeout=60) != "/chatter may not be shown: out of resources":
            pass
    publisher.publish(b"\0\1\0\0\0")
    assert heard.get(timeout=60) == b"\0\1\0\0\0"  # by the former subscription
    source._node.create_publisher("/other", empty, QoS())
    while changed.get(timeout=60):
        pass
    assert heard.get(timeout=60) == b"\0\1\0\0\0"  # again, because it was latched


def test_the_transforms_of_a_robot_in_a_namespace(monkeypatch):
    monkeypatch.setenv("RMW_IMPLEMENTATION", "local")
    topics = TfTopics("/robot1/tf", "/robot1/tf_static")
    with contextlib.closing(LiveSource(topics=topics)) as source:
        graph = source._context.graph
        heard = {end.topic for end in graph.endpoints() if end.kind == "subscription"}
    assert heard == {"/robot1/tf", "/robot1/tf_static"}


def test_a_page_goes_back_as_far_as_the_history():
    timeline = LiveTimeline(History(0, 5 * SECOND, 100 * SECOND))
    assert (timeline.state().oldest, timeline.state().newest) == (90.0, 100.0)
    for asked, shown in ((89, 90), (90, 90), (91, 91), (100, 100), (101, 100)):
        timeline.seek(asked * SECOND)
        assert timeline.stamp_ns() == shown * SECOND
        assert timeline.state().now == shown
    young = LiveTimeline(History(95 * SECOND, 100 * SECOND))
    assert young.state().oldest == 95.0


def test_a_paused_timeline_stays_until_it_is_played():
    source = History(SECOND, 2 * SECOND)
    timeline = LiveTimeline(source)
    assert (timeline.stamp_ns(), timeline.state().live) == (None, True)
    for _ in range(2):  # a second pause keeps the first one's picture
        timeline.pause()
        source.add(3 * SECOND)
        assert (timeline.stamp_ns(), timeline.state().newest) == (2 * SECOND, 2.0)
        assert not timeline.state().live
    timeline.seek(3 * SECOND)
    assert timeline.stamp_ns() == 2 * SECOND
    timeline.play()
    assert (timeline.stamp_ns(), timeline.state().now) == (None, 3.0)
    timeline.pause()
    assert timeline.stamp_ns() == 3 * SECOND


@pytest.mark.parametrize(("newest_ns", "is_simulated"), [(WALL_NS - 1, True), (WALL_NS, False)])
def test_stamps_of_a_simulation_are_told_by_their_size(source, newest_ns, is_simulated):
    source.buffer.set_transform("map", "base", newest_ns, (0.0, 0.0, 0.0))
    assert source.new_timeline().state().simulated is is_simulated
    assert (source.now_ns() == newest_ns) is is_simulated


def test_without_moving_frames_there_is_no_history(source):
    source.buffer.set_static_transform("map", "base", (0.0, 0.0, 0.0))
    timeline = source.new_timeline()
    timeline.pause()
    assert (timeline.stamp_ns(), timeline.state().oldest, timeline.state().newest) == (None, 0, 0)
    assert source.now_ns() > WALL_NS


LIMIT_S = 60


@pytest.fixture
def watched():
    with contextlib.closing(LiveSource()) as watched:
        yield watched


@pytest.fixture
def describer():
    """Starts nodes that have the given parameters."""
    stack = contextlib.ExitStack()

    def describer(name="describer", **parameters):
        context = rclpy.Context()
        context.init()
        stack.callback(context.try_shutdown)
        given = [Parameter(key, value=value) for key, value in parameters.items()]
        node = rclpy.create_node(
            name, context=context, parameter_overrides=given,
            automatically_declare_parameters_from_overrides=True,
        )  # fmt: skip
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin)
        thread.start()
        stack.callback(thread.join)
        stack.callback(executor.shutdown)
        return node

    with stack:
        yield describer


@contextlib.contextmanager
def asked(watched, node, name):
    """Ask for a parameter; gives the queue of the answers."""
    answers = queue.SimpleQueue()
    end = watched.ask_parameter(node, name, answers.put)
    try:
        yield answers
    finally:
        end()


def wait_for(answers, accept):
    while True:
        answer = answers.get(timeout=LIMIT_S)
        if accept(answer):
            return answer


def test_the_text_of_a_node_that_comes_later(watched, describer):
    with asked(watched, "/describer", "robot") as answers:
        absent = answers.get(timeout=LIMIT_S)
        assert absent.problem.startswith("there is no node /describer with parameters; nodes with ")
        describer(robot="<robot/>")
        assert wait_for(answers, lambda answer: answer.text) == ParameterAnswer("<robot/>")


def test_a_node_that_starts_before_another_ends_is_asked(watched, describer):
    first = describer(robot="<first/>")
    with asked(watched, "/describer", "robot") as answers:
        wait_for(answers, lambda answer: answer.text == "<first/>")
        describer(robot="<second/>")
        first.destroy_node()
        wait_for(answers, lambda answer: answer.text == "<second/>")


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("none", "the node /describer has no parameter 'none'"),
        ("count", "the parameter 'count' of /describer is an integer, no string"),
    ],
)
def test_why_there_is_no_text(watched, describer, name, why):
    describer(count=3)
    with asked(watched, "/describer", name) as answers:
        assert wait_for(answers, lambda answer: answer.problem == why)


def test_a_request_that_cannot_be_sent_is_a_problem(watched, describer, monkeypatch):
    def fail(_):
        raise WireError("out of resources")

    answers = queue.SimpleQueue()
    calls = watched.ask_service("/reset", "std_srvs/srv/Empty", answers.put)
    monkeypatch.setattr(calls._client, "send_request", fail)
    describer().create_service(Empty, "/reset", lambda _, response: response)
    wait_for(answers, lambda answer: answer.problem == "out of resources")
    monkeypatch.undo()
    calls.again()
    wait_for(answers, lambda answer: answer.cdr)
    calls.close()


def test_no_lock_is_held_while_an_answer_is_given(watched, describer):
    """The graph's news can be taken while the callback of an answer has not returned."""
    entered, left, texts = threading.Event(), threading.Event(), queue.SimpleQueue()

    def take(answer):
        if answer.text:
            texts.put(answer.text)
        entered.set()
        assert left.wait(LIMIT_S)

    end = watched.ask_parameter("/describer", "robot", take)
    assert entered.wait(LIMIT_S)
    describer(robot="<robot/>")
    graph = watched._context.graph
    assert graph.wait_for(
        lambda: any(n.name == "describer" for n in graph.nodes()), 10**9 * LIMIT_S
    )
    told = threading.Thread(target=graph.notify_changed, daemon=True)
    told.start()
    told.join(LIMIT_S)
    assert not told.is_alive()
    left.set()
    assert texts.get(timeout=LIMIT_S) == "<robot/>"
    end()


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("/not a node", "namespace must not contain characters other than"),
        ("describer", "namespace must be absolute"),
        ("", "namespace must not be empty"),
    ],
)
def test_a_name_that_no_node_has(watched, name, fault):
    with asked(watched, name, "robot") as answers:
        problem = answers.get(timeout=LIMIT_S).problem
    assert problem.startswith(f"{name!r} is not the name of a node: {fault}")


def test_a_changed_parameter_is_followed(watched, describer, robot):
    """Its node's own event may come before the view has found that publisher: one more is sent."""
    node = describer(robot="<robot/>")
    events = robot.publisher("/parameter_events", "rcl_interfaces/msg/ParameterEvent", QoS())
    with asked(watched, "/describer", "robot") as answers:
        assert robot.wait_for(events.is_heard)
        assert wait_for(answers, lambda answer: answer.text).text == "<robot/>"
        for kind in ("new", "changed"):
            text = f"<robot name='{kind}'/>"
            node.set_parameters([Parameter("robot", value=text)])
            event = msg.get_message("rcl_interfaces/msg/ParameterEvent")(node="/describer")
            changed = msg.get_message("rcl_interfaces/msg/Parameter")(name="robot")
            setattr(event, f"{kind}_parameters", [changed])
            events.publish(msg.serialize(event))
            wait_for(answers, lambda answer, text=text: answer.text == text)


def test_a_node_that_would_misread_the_request_is_named(watched, foreign_server):
    foreign_server("/stranger/get_parameters", "rcl_interfaces/srv/GetParameters")
    with asked(watched, "/stranger", "robot") as answers:
        answer = wait_for(answers, lambda answer: "is not called" in answer.problem)
    assert "Start the server with RMW_IMPLEMENTATION=rmw_cyclonedds_cpp" in answer.problem
