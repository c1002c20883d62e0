"""The clock of an asynchronous node."""

from __future__ import annotations

import asyncio

from rclpy.clock import BaseClock, ClockChange, JumpThreshold, TimeJump
from rclpy.clock_type import ClockType
from rclpy.constants import S_TO_NS
from rclpy.duration import Duration
from rclpy.exceptions import TimeSourceChangedError
from turtlewire.wake_up import LoopWakeUp


class AsyncClock(BaseClock):
    """A clock whose sleeps are awaited."""

    _is_destroyed = False
    _sleeps: set[_Sleep]

    def __init__(
        self,
        *,
        clock_type: ClockType = ClockType.SYSTEM_TIME,  # noqa: ARG002 - `__new__` uses it
    ) -> None:
        self._sleeps = set()

    def __repr__(self) -> str:
        return f"AsyncClock(clock_type={self._clock_type.name})"

    async def sleep(self, duration_sec: float) -> None:
        """Wait until this clock has advanced by a duration.

        Simulated time advances with the messages on ``/clock``, while the node runs.

        Args:
            duration_sec: Seconds; 0 and less let other tasks run once.

        Raises:
            TimeSourceChangedError: The clock began or ended to follow ``/clock`` meanwhile.
            asyncio.CancelledError: The node was destroyed during the sleep.
            RuntimeError: The node was destroyed before.
        """
        if self._is_destroyed:
            raise RuntimeError("Cannot sleep on a destroyed clock")
        if duration_sec <= 0:
            await asyncio.sleep(0)
            return
        sleep = _Sleep(self, self._now_ns() + int(duration_sec * S_TO_NS))
        self._sleeps.add(sleep)
        try:
            await sleep.run()
        finally:
            self._sleeps.discard(sleep)

    def _destroy(self) -> None:
        """Cancel all sleeps, now and in the future."""
        self._is_destroyed = True
        for sleep in self._sleeps:
            sleep.wake_up.set()


class _Sleep:
    """A wait for a time."""

    def __init__(self, clock: AsyncClock, until_ns: int) -> None:
        self._clock = clock
        self._until_ns = until_ns
        self._source_changed = False
        self.wake_up = LoopWakeUp(asyncio.get_running_loop())

    async def run(self) -> None:
        clock = self._clock
        # Every move forwards may reach the time; a jump backwards cannot.
        smallest = Duration(nanoseconds=1)
        threshold = JumpThreshold(min_forward=smallest, min_backward=None, on_clock_change=True)
        with clock.create_jump_callback(threshold, post_callback=self._on_jump):
            while not self._source_changed:
                remaining_ns = self._until_ns - clock._now_ns()
                if remaining_ns <= 0:
                    return
                await self.wake_up.wait(
                    None if clock.ros_time_is_active else remaining_ns / S_TO_NS
                )
                if clock._is_destroyed:
                    raise asyncio.CancelledError
        raise TimeSourceChangedError

    def _on_jump(self, jump: TimeJump) -> None:
        self._source_changed |= jump.clock_change is not ClockChange.ROS_TIME_NO_CHANGE
        self.wake_up.set()
