"""use_sim_time and /clock."""

import pytest

from builtin_interfaces.msg import Time as TimeMsg
from rclpy.clock import Clock, ClockType, ROSClock
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import ReliabilityPolicy
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rosgraph_msgs.msg import Clock as ClockMsg


@pytest.fixture
def simulator(context):
    simulator = Node("simulator", context=context)
    simulator.clock_publisher = simulator.create_publisher(ClockMsg, "/clock", 1)
    yield simulator
    simulator.destroy_node()


def clock_subscriptions(node):
    return [each for each in node.subscriptions if each.topic_name == "/clock"]


def publish(simulator, seconds):
    simulator.clock_publisher.publish(ClockMsg(clock=TimeMsg(sec=seconds)))


def use_sim_time(node, value):
    (result,) = node.set_parameters([Parameter("use_sim_time", value=value)])
    return result


def test_the_system_time_is_the_default(node):
    assert node.get_parameter("use_sim_time").value is False
    assert not node.get_clock().ros_time_is_active
    assert clock_subscriptions(node) == []
    assert node.get_clock().now().nanoseconds > 10**18


def test_the_clock_follows_while_the_parameter_is_true(node, executor, simulator):
    assert use_sim_time(node, True).successful
    assert node.get_clock().now() == Time(clock_type=ClockType.ROS_TIME)
    (subscription,) = clock_subscriptions(node)
    assert (subscription.qos_profile.depth, subscription.qos_profile.reliability) == (
        1,
        ReliabilityPolicy.BEST_EFFORT,
    )
    for seconds in (5, 7, 3):
        publish(simulator, seconds)
        executor.spin_once(timeout_sec=60)
        assert node.get_clock().now().seconds_nanoseconds() == (seconds, 0)
    assert use_sim_time(node, False).successful
    assert clock_subscriptions(node) == []
    assert node.get_clock().now().nanoseconds > 10**18


def test_the_command_line_turns_it_on(context):
    node = Node("simulated", context=context, cli_args=["--ros-args", "-p", "use_sim_time:=true"])
    assert node.get_clock().ros_time_is_active
    assert len(clock_subscriptions(node)) == 1


def test_nothing_but_a_bool(node):
    assert not use_sim_time(node, 1).successful
    assert not node.get_clock().ros_time_is_active


def test_a_dynamic_parameter_of_another_type(context, capfd):
    words = ["--ros-args", "-p", "use_sim_time:=yes please"]
    node = Node(
        "wrong",
        context=context,
        cli_args=words,
        automatically_declare_parameters_from_overrides=True,
    )
    assert (
        "Invalid type for parameter 'use_sim_time' <Type.STRING: 4> should be bool"
        in capfd.readouterr().err
    )
    (result,) = node.set_parameters([Parameter("use_sim_time", value=2)])
    assert result.reason == "use_sim_time parameter set to something besides a bool"


def test_a_simulated_timer_fires_with_the_clock(node, executor, simulator):
    """A timer on ROS time counts simulated seconds; it stands still until the first message."""
    assert use_sim_time(node, True).successful
    fired = []
    node.create_timer(10.0, lambda: fired.append(node.get_clock().now().nanoseconds // 10**9))
    for seconds in (1, 5, 9):
        publish(simulator, seconds)
        executor.spin_once(timeout_sec=60)
    executor.spin_once(timeout_sec=0)
    assert fired == []
    publish(simulator, 12)
    for _ in range(100):
        if fired:
            break
        executor.spin_once(timeout_sec=0.1)
    assert fired == [12]


def test_more_clocks_can_be_attached(node, executor, simulator):
    source = TimeSource(node=node)
    clock = ROSClock()
    source.attach_clock(clock)
    with pytest.raises(ValueError, match=r"^Only clocks with type ROS_TIME can be attached\.$"):
        source.attach_clock(Clock())
    assert use_sim_time(node, True).successful
    publish(simulator, 4)
    for _ in range(100):
        if clock.now().nanoseconds == 4 * 10**9:
            break
        executor.spin_once(timeout_sec=0.1)
    assert clock.now().nanoseconds == 4 * 10**9
    late = ROSClock()
    source.attach_clock(late)
    assert late.now() == clock.now()
    source.detach_node()
    assert len(clock_subscriptions(node)) == 1


def test_a_negative_time_is_left_out_and_said(node, executor, simulator, capfd):
    assert use_sim_time(node, True).successful
    for seconds in (-5, 7):
        publish(simulator, seconds)
        executor.spin_once(timeout_sec=60)
    assert node.get_clock().now().seconds_nanoseconds() == (7, 0)
    assert "Ignoring a negative time on '/clock' (-5 s)" in capfd.readouterr().err
