"""Gaps in the stamps of transforms: loss is found, and other patterns are not mistaken for it."""

import random
import re
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.places import TURTLEWIRE

from turtlewire.doctor.tf_findings import find_gaps

SEEDS = st.integers(0, 10_000)


def nanoseconds(times):
    return [round(1e9 * seconds) for seconds in times]


def rhythm(count, period, *, loss=0.0, jitter=0.0, seed=1):
    """Stamps of a timer of which some are lost."""
    chance = random.Random(seed)
    due = [k * period + chance.uniform(-jitter, jitter) for k in range(count)]
    return nanoseconds(at for at in due if chance.random() >= loss)


@pytest.mark.parametrize("loss", [0.5, 0.6, 0.75])
@pytest.mark.parametrize("jitter", [0.0, 0.001])
def test_loss_is_told_with_share_and_period(loss, jitter):
    gaps = find_gaps(rhythm(400, 0.02, loss=loss, jitter=jitter))
    assert gaps.share == pytest.approx(loss, abs=0.1)
    assert gaps.period_s == pytest.approx(0.02, rel=0.05)
    assert gaps.longest_s > 0.06


def test_the_order_of_the_stamps_does_not_matter():
    stamps = rhythm(200, 0.02, loss=0.6)
    assert find_gaps(stamps[::-1]) == find_gaps(stamps)


@settings(max_examples=200, deadline=None)
@given(SEEDS, st.sampled_from([0.01, 0.016, 0.1]), st.floats(0.0, 0.1))
def test_a_jittering_timer_and_a_few_lost_ones_are_no_fault(seed, period, jitter):
    assert find_gaps(rhythm(100, period, jitter=jitter * period, loss=0.05, seed=seed)) is None


@pytest.mark.parametrize("seed", range(50))
def test_no_rhythm_is_no_loss(seed):
    chance = random.Random(seed)
    moments = [0.0]
    for _ in range(40):
        moments.append(moments[-1] + 0.002 + chance.expovariate(20.0))
    assert find_gaps(nanoseconds(moments)) is None


@pytest.mark.parametrize("stall", [0.05, 0.3, 1.0])
def test_a_publisher_that_is_held_up_now_and_then_loses_nothing(stall):
    moments, now = [], 0.0
    for k in range(100):
        now += 0.02 + (stall if k % 20 == 10 else 0.0)
        moments.append(now)
    assert find_gaps(nanoseconds(moments)) is None


def test_a_clock_that_ticks_faster_than_transforms_come_is_no_loss():
    moments = [round(k / 30.0, 2) for k in range(100)]  # 30 Hz on a clock of 100 Hz
    assert find_gaps(nanoseconds(moments)) is None


@pytest.mark.parametrize("stamps", [[], [5], [7] * 100, list(range(0, 10**9, 10**8))])
def test_too_few_moments_say_nothing(stamps):
    assert find_gaps(stamps) is None


def stamps_of(*periods, period_ns=20_000_000):
    """Return stamps that are this many periods apart."""
    return [sum(periods[:k]) * period_ns for k in range(len(periods) + 1)]


LOSS = (1, 1, 1, 1, 1, 2, 2, 3, 4, 4)


def test_ten_steps_are_enough():
    gaps = find_gaps(stamps_of(*LOSS))
    assert (gaps.share, gaps.period_s, gaps.longest_s) == pytest.approx((0.5, 0.02, 0.08))
    assert find_gaps(stamps_of(*LOSS[:-1])) is None


def test_a_lack_of_three_tenths_is_enough():
    steps = [1] * 27 + [2, 2, 2, 3, 3, 3, 4, 4]
    assert find_gaps(stamps_of(*steps)).share == pytest.approx(0.3)
    assert find_gaps(stamps_of(*steps, 1)) is None


@pytest.mark.parametrize(("apart_ns", "period_s"), [(0, 0.02), (1_000_000, 0.02), (1_000_001, 0)])
def test_stamps_within_a_millisecond_are_one_moment(apart_ns, period_s):
    stamps = stamps_of(*LOSS)
    gaps = find_gaps(stamps + [stamp + apart_ns for stamp in stamps])
    assert (0.0 if gaps is None else gaps.period_s) == pytest.approx(period_s, rel=0.1, abs=0.002)


LOSSY = """
import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from turtlesim.testing.faults import Loss

rclpy.init()
node, loss = Node("lossy"), Loss(0.5)
broadcaster = TransformBroadcaster(node)

def send():
    transform = TransformStamped()
    transform.header.stamp = node.get_clock().now().to_msg()
    transform.header.frame_id, transform.child_frame_id = "world", "turtle1"
    transform.transform.rotation.w = 1.0
    if loss.delay_s(transform) is not None:
        broadcaster.sendTransform(transform)

node.create_timer(0.02, send)
rclpy.spin(node)
"""


@pytest.mark.slow
@pytest.mark.timeout(120)
def test_the_doctor_tells_of_loss_on_the_wire(run):
    """A busy host holds the timer up, and its rhythm is none: the doctor is asked again."""
    run(sys.executable, "-c", LOSSY)
    doctor = [TURTLEWIRE, "doctor"]
    told = ""
    while not re.search("About [3-7].% of the transforms of 'turtle1' are missing", told):
        told = subprocess.run(doctor, capture_output=True, text=True, check=False).stdout
