import pytest
from hypothesis import given
from hypothesis import strategies as st

from builtin_interfaces.msg import Duration as DurationMsg
from builtin_interfaces.msg import Time as TimeMsg
from rclpy.clock_type import ClockType
from rclpy.duration import Duration, Infinite
from rclpy.time import Time

INT64_MAX = 2**63 - 1
stamps = st.integers(0, INT64_MAX)
spans = st.integers(-(2**63), INT64_MAX)
#: What the messages can hold: 32-bit seconds.
message_stamps = st.integers(0, 2**31 * 10**9 - 1)
message_spans = st.integers(-(2**31) * 10**9, 2**31 * 10**9 - 1)


@given(stamps, spans)
def test_adding_and_subtracting_a_duration_are_inverse(stamp, span):
    time = Time(nanoseconds=stamp, clock_type=ClockType.ROS_TIME)
    duration = Duration(nanoseconds=span)
    if stamp + span > INT64_MAX:
        with pytest.raises(OverflowError, match=r"^Addition leads to overflow in C storage\.$"):
            time + duration
    elif stamp + span >= 0:
        assert (time + duration).nanoseconds == stamp + span
        assert duration + time == time + duration
        assert (time + duration) - duration == time
        assert (time + duration) - time == duration


def order(a, b):
    return a < b, a <= b, a == b, a != b, a >= b, a > b


@given(stamps, stamps)
def test_times_compare_and_differ_as_their_nanoseconds(one, other):
    first, second = Time(nanoseconds=one), Time(nanoseconds=other)
    assert order(first, second) == order(one, other)
    assert (first - second).nanoseconds == one - other


@given(spans, spans)
def test_durations_compare_as_their_nanoseconds(one, other):
    first, second = Duration(nanoseconds=one), Duration(nanoseconds=other)
    assert order(first, second) == order(one, other)


@given(message_stamps)
def test_a_time_survives_its_message(stamp):
    time = Time(nanoseconds=stamp, clock_type=ClockType.ROS_TIME)
    message = time.to_msg()
    assert (message.sec, message.nanosec) == time.seconds_nanoseconds()
    assert Time.from_msg(message) == time


@given(message_spans)
def test_a_duration_survives_its_message(span):
    message = Duration(nanoseconds=span).to_msg()
    assert 0 <= message.nanosec < 10**9
    assert Duration.from_msg(message).nanoseconds == span


def test_float_seconds_are_rounded_towards_zero():
    assert Time(seconds=1.5, nanoseconds=2).nanoseconds == 1_500_000_002
    assert Duration(seconds=-0.1).nanoseconds == -100_000_000
    assert Duration(seconds=1e-10).nanoseconds == 0


@pytest.mark.parametrize(
    ("keywords", "error", "text"),
    [
        ({"seconds": -1}, ValueError, "Seconds value must not be negative"),
        ({"nanoseconds": -1}, ValueError, "Nanoseconds value must not be negative"),
        (
            {"nanoseconds": 2**63},
            OverflowError,
            "Total nanoseconds value is too large to store in C time point.",
        ),
        (
            {"seconds": 10**10},
            OverflowError,
            "Total nanoseconds value is too large to store in C time point.",
        ),
        ({"clock_type": "SYSTEM_TIME"}, TypeError, "Clock type must be a ClockType enum"),
    ],
)
def test_bad_times(keywords, error, text):
    with pytest.raises(error) as caught:
        Time(**keywords)
    assert str(caught.value) == text


def test_bad_durations():
    for nanoseconds in (2**63, -(2**63) - 1):
        with pytest.raises(
            OverflowError, match=r"^Total nanoseconds value is too large to store in C duration\.$"
        ):
            Duration(nanoseconds=nanoseconds)


def test_time_before_zero():
    with pytest.raises(ValueError, match=r"^Subtraction leads to negative time\.$"):
        Time(nanoseconds=1) - Duration(nanoseconds=2)


def test_clock_types_do_not_mix():
    system, ros = Time(nanoseconds=1), Time(nanoseconds=1, clock_type=ClockType.ROS_TIME)
    for compare in ("__eq__", "__ne__", "__lt__", "__le__", "__gt__", "__ge__"):
        with pytest.raises(TypeError, match=r"^Can't compare times with different clock types$"):
            getattr(system, compare)(ros)
    with pytest.raises(TypeError, match=r"^Can't subtract times with different clock types$"):
        system - ros


def test_other_types():
    assert (Time() == 0) is (Duration() == 0) is False
    for operation in (
        lambda: Time() + 1,
        lambda: Time() - 1,
        lambda: Time() < 1,
        lambda: Duration() < 1,
    ):
        with pytest.raises(TypeError):
            operation()
    with pytest.raises(TypeError, match=r"^Must pass a builtin_interfaces.msg.Time object$"):
        Time.from_msg(DurationMsg())
    with pytest.raises(TypeError, match=r"^Must pass a builtin_interfaces.msg.Duration object$"):
        Duration.from_msg(TimeMsg())


def test_texts():
    assert (
        repr(Time(seconds=1, clock_type=ClockType.ROS_TIME))
        == "Time(nanoseconds=1000000000, clock_type=ROS_TIME)"
    )
    assert repr(Duration(seconds=1)) == "Duration(nanoseconds=1000000000)"
    assert str(Duration(nanoseconds=5)) == "5 nanoseconds"
    assert str(Infinite) == "Infinite"
    assert Time.from_msg(TimeMsg()).clock_type is ClockType.ROS_TIME
    assert Time().clock_type is ClockType.SYSTEM_TIME
