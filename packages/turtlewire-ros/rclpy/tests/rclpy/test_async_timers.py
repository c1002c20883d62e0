"""Timers and clocks of asynchronous nodes. The outcomes are those of ROS 2 Lyrical."""

import asyncio
import time

from rclpy.clock import ClockType
from rclpy.experimental import AsyncClock, AsyncNode
from rclpy.parameter import Parameter
from rclpy.time import Time
from rclpy.timer import TimerInfo
from rosgraph_msgs.msg import Clock

from .asyncio_nodes import Simulation, failure, failure_of, turns, until


async def test_the_arguments_of_a_timer_callback(context):
    infos = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        assert failure_of(node.create_timer, 1.0, lambda _a, _b: None) == (
            "RuntimeError",
            "Timer callback must accept zero arguments or one argument (TimerInfo)",
        )
        assert failure_of(node.create_timer, 1.0, None)[0] == "TypeError"
        simulation = Simulation(node, 10.0)
        node.create_timer(2.0, infos.put)
        simulation.set(12.5)
        info = await infos.get()
        assert type(info) is TimerInfo
        assert info.expected_call_time == Time(seconds=12, clock_type=ClockType.ROS_TIME)
        assert info.actual_call_time == Time(seconds=12.5, clock_type=ClockType.ROS_TIME)


async def test_a_timer_is_cancelled_and_reset(context):
    calls = []
    async with AsyncNode("tested", context=context) as node:
        simulation = Simulation(node)

        async def advance(seconds):
            simulation.set(simulation.seconds + seconds)
            await turns()
            return len(calls)

        timer = node.create_timer(1.0, lambda: calls.append("first"))
        assert await advance(1.0) == 1
        timer.cancel()
        assert await advance(5.0) == 1
        timer.reset()
        assert await advance(0.5) == 1
        assert await advance(0.5) == 2
        timer.destroy()
        assert await advance(5.0) == 2
        waiting = node.create_timer(1.0, lambda: calls.append("second"), autostart=False)
        assert await advance(5.0) == 2
        waiting.reset()
        assert await advance(1.0) == 3


async def test_a_slow_callback_is_called_again_at_once_but_only_once(context):
    called_at = []
    async with AsyncNode("tested", context=context) as node:
        simulation = Simulation(node)

        async def slow():
            called_at.append(round(simulation.seconds, 2))
            simulation.set(simulation.seconds + 0.25)
            await asyncio.sleep(0)
            if len(called_at) == 5:
                node.destroy_node()

        node.create_timer(0.1, slow)
        simulation.set(0.1)
        await turns(50)
    assert called_at == [0.1, 0.35, 0.6, 0.85, 1.1]


async def test_a_period_of_zero_leaves_the_loop_to_others(context):
    ticks = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        node.create_timer(0.0, lambda: ticks.put_nowait(None))
        for _ in range(3):
            await ticks.get()


async def test_a_timer_of_the_systems_time(context):
    ticks = asyncio.Queue()
    async with AsyncNode("tested", context=context) as node:
        begin = time.monotonic()
        node.create_timer(0.02, lambda: ticks.put_nowait(time.monotonic()))
        times = [await ticks.get() for _ in range(3)]
    assert times[-1] - begin >= 0.06 - 0.001
    assert times == sorted(times)


async def test_simulated_time_of_the_clock_topic(context):
    node = AsyncNode("tested", context=context)
    clock = node.get_clock()
    async with node:
        begin = time.monotonic()
        await clock.sleep(0.01)
        assert time.monotonic() - begin >= 0.009
        await clock.sleep(-1.0)
        sleeping = asyncio.ensure_future(clock.sleep(100))
        await turns()
        node.set_parameters([Parameter("use_sim_time", value=True)])
        assert await failure(sleeping) == ("TimeSourceChangedError", "")

        publisher = node.create_publisher(Clock, "/clock", 10)

        async def show(seconds):
            message = Clock()
            message.clock.sec = seconds
            publisher.publish(message)
            await until(lambda: clock.now().nanoseconds == seconds * 10**9)
            await turns()

        await show(100)
        sleeping = asyncio.ensure_future(clock.sleep(10.0))
        await turns()
        await show(109)
        assert not sleeping.done()
        await show(110)
        await sleeping

        fired = []
        node.create_timer(5.0, lambda: fired.append(clock.now().nanoseconds // 10**9))
        await turns()
        for seconds in (112, 116, 117, 127):
            await show(seconds)
        assert fired == [116, 127]
        sleeping = asyncio.ensure_future(clock.sleep(1000))
        await turns()
    assert await failure(sleeping) == ("CancelledError", "")
    assert await failure(clock.sleep(1)) == (
        "RuntimeError",
        "Cannot sleep on a destroyed clock",
    )


def test_the_kinds_of_clocks():
    assert repr(AsyncClock()) == "AsyncClock(clock_type=SYSTEM_TIME)"
    steady = AsyncClock(clock_type=ClockType.STEADY_TIME)
    assert abs(steady.now().nanoseconds - time.monotonic_ns()) < 60 * 10**9
