"""Waiting for a transform inside the callbacks of a single-threaded executor.

Whatever comes when, it never hangs, and answers right.
"""

from __future__ import annotations

import threading
from typing import NamedTuple

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import TransformStamped
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import Int32
from tf2_ros import (
    Buffer,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformException,
    TransformListener,
)

HALF_NS = 500_000_000
#: How far a link moves along x or y in a half second; linear, so that any two samples around a
#: stamp give the same answer.
SPEEDS = {"base": (1.0, 0.0), "robot": (0.0, 10.0)}
PARENTS = {"base": "world", "robot": "base"}
LONG, SHORT = Duration(seconds=60), Duration(seconds=0.01)


class Sample(NamedTuple):
    """A transform to publish, this many half seconds after zero."""

    child: str
    halves: int


class Question(NamedTuple):
    """A lookup inside a callback."""

    kind: str
    halves: int


halves = st.integers(2, 10)
samples = st.builds(Sample, st.sampled_from(sorted(SPEEDS)), halves)
questions = st.lists(
    st.builds(Question, st.sampled_from(["timer", "subscription", "service"]), halves),
    min_size=1,
    max_size=4,
)


@st.composite
def schedules(draw):
    """Questions, and the order in which they and the samples come, with pauses [s] in between."""
    asked = draw(questions)
    come = draw(st.lists(samples, max_size=8, unique=True))
    if draw(st.booleans()):  # everything can be answered in the end
        come = sorted({*come, *(Sample(child, half) for child in SPEEDS for half in (2, 10))})
    order = draw(st.permutations([*come, *range(len(asked))]))
    return asked, [(what, draw(st.sampled_from([0.0, 0.0, 0.001, 0.003]))) for what in order]


def transform(child, half):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = PARENTS[child]
    message.header.stamp = Time(nanoseconds=half * HALF_NS).to_msg()
    message.transform.translation.x, message.transform.translation.y = (
        speed * half for speed in SPEEDS[child]
    )
    return message


def expected(question, come, static):
    """The place of the robot, or None when what comes does not reach the stamp of the question."""
    x, y = (speed * question.halves for speed in (SPEEDS["base"][0], SPEEDS["robot"][1]))
    for child in SPEEDS:
        known = [sample.halves for sample in come if sample.child == child]
        if child == static and known:
            y = SPEEDS["robot"][1]
        elif not known or not min(known) <= question.halves <= max(known):
            return None
    return x, y


class Run:
    """One schedule: an executor that spins, and a thread that publishes."""

    def __init__(self, context, asked, order, static):
        self.asked, self.order, self.static = asked, order, static
        come = [what for what, _ in order if isinstance(what, Sample)]
        self.expected = [expected(question, come, static) for question in asked]
        self.answers, self.finished = {}, set()
        self.done = Future()
        self.node, self.other = Node("asking", context=context), Node("other", context=context)
        self.buffer = Buffer()
        TransformListener(self.buffer, self.node)
        self.broadcasters = {
            child: TransformBroadcaster(self.other) for child in SPEEDS if child != static
        }
        if static:
            self.broadcasters[static] = StaticTransformBroadcaster(self.other)
        self.numbers = self.other.create_publisher(Int32, "numbers", 10)
        self.node.create_subscription(
            Int32, "numbers", lambda message: self.answer(message.data), 10
        )
        self.node.create_service(AddTwoInts, "ask", self.serve)
        self.client = self.other.create_client(AddTwoInts, "ask")
        self.executor = SingleThreadedExecutor(context=context)
        for node in (self.node, self.other):
            self.executor.add_node(node)
        self.timers = {
            i: self.node.create_timer(0.0, lambda i=i: self.tick(i), autostart=False)
            for i, q in enumerate(asked)
            if q.kind == "timer"
        }

    def tick(self, i):
        self.timers[i].cancel()
        self.answer(i)

    def serve(self, request, response):
        response.sum = request.a
        self.answer(request.a, finish=False)
        return response

    def answer(self, i, *, finish=True):
        """Wait in a callback; what cannot come is waited for only shortly."""
        timeout = LONG if self.expected[i] else SHORT
        try:
            place = self.buffer.lookup_transform(
                "world", "robot", Time(nanoseconds=self.asked[i].halves * HALF_NS), timeout
            )
        except TransformException as error:
            self.answers[i] = error
        else:
            self.answers[i] = (place.transform.translation.x, place.transform.translation.y)
        if finish:
            self.finish(i)

    def finish(self, i):
        assert i in self.answers
        self.finished.add(i)
        if len(self.finished) == len(self.asked):
            self.done.set_result(True)

    def come(self):
        for what, pause_s in self.order:
            if pause_s:
                threading.Event().wait(pause_s)
            if isinstance(what, Sample):
                self.broadcasters[what.child].sendTransform(
                    transform(what.child, 1 if what.child == self.static else what.halves)
                )
            elif self.asked[what].kind == "timer":
                self.timers[what].reset()
            elif self.asked[what].kind == "subscription":
                self.numbers.publish(Int32(data=what))
            else:
                self.client.call_async(AddTwoInts.Request(a=what)).add_done_callback(
                    lambda future: self.finish(future.result().sum)
                )

    def go(self):
        thread = threading.Thread(target=self.come)
        thread.start()
        self.executor.spin_until_future_complete(self.done, timeout_sec=60)
        thread.join()
        for node in (self.node, self.other):
            node.destroy_node()
        assert self.done.done(), f"answered: {self.answers}"


def check(schedule, static):
    with Context() as context:
        run = Run(context, *schedule, static)
        run.go()
    for i, wanted in enumerate(run.expected):
        event(f"{run.asked[i].kind}: {'answered' if wanted else 'cannot come'}")
        if wanted is None:
            assert isinstance(run.answers[i], TransformException)
        else:
            assert run.answers[i] == pytest.approx(wanted, abs=1e-9)


@settings(max_examples=80)
@given(schedules(), st.sampled_from([None, "robot"]))
def test_waiting_never_hangs_and_answers_right(schedule, static):
    check(schedule, static)


@pytest.mark.usefixtures("real_middleware")
@settings(max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(schedules(), st.sampled_from([None, "robot"]))
def test_waiting_over_dds_never_hangs_and_answers_right(schedule, static):
    check(schedule, static)
