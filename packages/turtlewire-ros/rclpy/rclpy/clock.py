"""Clocks: the system's, a steady one, and ROS time, which a simulation may drive.

Jump callbacks run on the thread that moves the clock, without a lock held. All clocks are
thread-safe.
"""

from __future__ import annotations

import threading
import time
import warnings
from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING, Any

from turtlewire.distro import LYRICAL, since
from turtlewire.wake_up import WakeUp

from ._execution.handle import Handle
from ._rclpy_pybind11 import RCLError
from .clock_type import ClockType
from .constants import S_TO_NS
from .duration import Duration
from .exceptions import NotInitializedException
from .impl.hints import with_hint
from .time import Time

if TYPE_CHECKING:
    from typing_extensions import Self

    from .context import Context

__all__ = [
    "BaseClock",
    "Clock",
    "ClockChange",
    "ClockType",
    "JumpHandle",
    "JumpThreshold",
    "ROSClock",
    "TimeJump",
]


class ClockChange(Enum):
    """The change of a clock's time source at a jump."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class JumpThreshold:
    """A filter of the clock jumps that trigger a callback.

    Args:
        min_forward: Smallest jump forwards; None for no such jump.
        min_backward: Smallest jump backwards, a negative duration; None for no such jump.
        on_clock_change: Whether it counts when ROS time starts or stops to follow ``/clock``.

    Raises:
        ValueError: A duration has the wrong sign, or nothing is asked for.
    """

    def __init__(
        self,
        *,
        min_forward: Duration | None,
        min_backward: Duration | None,
        on_clock_change: bool = True,
    ) -> None:
        if min_forward is None and min_backward is None and not on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")
        if min_forward is not None and min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if min_backward is not None and min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        self.min_forward = min_forward
        self.min_backward = min_backward
        self.on_clock_change = on_clock_change

    def is_crossed_by(self, jump: TimeJump) -> bool:
        """Return True if ``jump`` crosses one of the thresholds."""
        if self.on_clock_change and jump.clock_change in (
            ClockChange.ROS_TIME_ACTIVATED,
            ClockChange.ROS_TIME_DEACTIVATED,
        ):
            return True
        if self.min_backward is not None and jump.delta <= self.min_backward:
            return True
        return self.min_forward is not None and jump.delta >= self.min_forward


class TimeJump:
    """A jump of a clock: how far, and whether its source changed."""

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        if not isinstance(clock_change, ClockChange):
            raise TypeError("clock_change must be an instance of rclpy.clock.ClockChange")
        self._clock_change = clock_change
        self._delta = delta

    @property
    def clock_change(self) -> ClockChange:
        """Change of the source of time."""
        return self._clock_change

    @property
    def delta(self) -> Duration:
        """Difference of the times; negative for a jump backwards."""
        return self._delta


class JumpHandle:
    """Keeps two jump callbacks registered, until :meth:`unregister` or the end of a ``with``."""

    def __init__(
        self,
        *,
        clock: BaseClock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], None] | None,
        post_callback: Callable[[TimeJump], None] | None,
    ) -> None:
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        if pre_callback is not None and not callable(pre_callback):
            raise ValueError("pre_callback must be callable if given")
        if post_callback is not None and not callable(post_callback):
            raise ValueError("post_callback must be callable if given")
        self._clock: BaseClock | None = clock
        self._threshold = threshold
        self._pre_callback = pre_callback
        self._post_callback = post_callback
        clock.add_jump_handle(self)

    def unregister(self) -> None:
        """Unregister the callback. Idempotent."""
        clock, self._clock = self._clock, None
        if clock is not None:
            clock.remove_jump_handle(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, t: object, v: object, tb: object) -> None:
        self.unregister()


class BaseClock:
    """A clock: a time, and callbacks around its jumps.

    A clock of ROS time may show the time of a simulation.
    """

    _override_ns = 0
    _override_is_active = False
    _clock_type: ClockType
    _jump_handles: list[JumpHandle]
    _lock: threading.Lock

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Self:
        """Make a clock of one type."""
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        self = super().__new__(cls)
        self._clock_type = clock_type
        self._jump_handles = []
        self._lock = threading.Lock()
        return self

    @property
    def clock_type(self) -> ClockType:
        """Type of the clock."""
        return self._clock_type

    @property
    def handle(self) -> Handle:
        """A stand-in for ROS 2's C object."""
        return Handle(self)

    @property
    def ros_time_is_active(self) -> bool:
        """True if the time comes from :meth:`set_ros_time_override` rather than from the system.

        Raises:
            RCLError: The clock is not one of ROS time.
        """
        self._require_ros_time("get ROS time override status", "query override state")
        return self._override_is_active

    def _now_ns(self) -> int:
        if self._override_is_active:
            return self._override_ns
        return time.monotonic_ns() if self._clock_type is ClockType.STEADY_TIME else time.time_ns()

    def now(self) -> Time:
        """Return the present time of this clock."""
        return Time(nanoseconds=self._now_ns(), clock_type=self._clock_type)

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], None] | None = None,
        post_callback: Callable[[TimeJump], None] | None = None,
    ) -> JumpHandle:
        """Ask to be called around jumps of this clock.

        Args:
            threshold: Which jumps.
            pre_callback: Called before the clock moves.
            post_callback: Called after it has moved, with the jump.

        Returns:
            A handle; ``unregister()`` ends it.
        """
        return JumpHandle(
            clock=self, threshold=threshold, pre_callback=pre_callback, post_callback=post_callback
        )

    def add_jump_handle(self, handle: JumpHandle) -> None:
        """Register ``handle`` for jumps; :meth:`create_jump_callback` makes one."""
        with self._lock:
            self._jump_handles.append(handle)

    def remove_jump_handle(self, handle: JumpHandle) -> None:
        """Undo :meth:`add_jump_handle`."""
        with self._lock:
            self._jump_handles.remove(handle)

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Follow the time that is set (it is 0 until then), or the system's."""
        if enabled == self._override_is_active:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if enabled else ClockChange.ROS_TIME_DEACTIVATED

        def switch() -> None:
            self._override_is_active = enabled

        self._move(TimeJump(change, Duration()), switch)

    def set_ros_time_override(self, time: Time) -> None:
        """Set the time that is shown while ROS time is active.

        Raises:
            TypeError: ``time`` is not a Time.
            RCLError: The clock is not one of ROS time.
        """
        self._require_ros_time("set ROS time override", "set time override")
        if not isinstance(time, Time):
            raise TypeError(
                f"Time must be specified as rclpy.time.Time. Received type: {type(time)}"
            )

        def switch() -> None:
            self._override_ns = time.nanoseconds

        if self._override_is_active:
            delta = Duration(nanoseconds=time.nanoseconds - self._override_ns)
            self._move(TimeJump(ClockChange.ROS_TIME_NO_CHANGE, delta), switch)
        else:
            switch()

    def _move(self, jump: TimeJump, switch: Callable[[], None]) -> None:
        with self._lock:
            handles = [each for each in self._jump_handles if each._threshold.is_crossed_by(jump)]
        for handle in handles:
            if handle._pre_callback is not None:
                handle._pre_callback()
        switch()
        for handle in handles:
            if handle._post_callback is not None:
                handle._post_callback(jump)

    def _require_ros_time(self, goal: str, step: str) -> None:
        if self._clock_type is not ClockType.ROS_TIME:
            raise with_hint(
                RCLError(f"failed to {goal}: Clock is not of type RCL_ROS_TIME, cannot {step}."),
                "Make the clock with Clock(clock_type=ClockType.ROS_TIME), or take the node's",
            )


class Clock(BaseClock):
    """A clock of one type.

    Up to Kilted, ``Clock(clock_type=ClockType.ROS_TIME)`` makes a :class:`ROSClock`.
    """

    # It may make a subclass.
    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Clock:  # noqa: PYI034
        """Choose the class by the clock type."""
        kind = ROSClock if clock_type is ClockType.ROS_TIME and not since(LYRICAL) else cls
        return BaseClock.__new__(kind, clock_type=clock_type)

    def __repr__(self) -> str:
        return f"Clock(clock_type={self._clock_type.name})"

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Wait until this clock shows ``until``.

        Args:
            until: A time of the same clock type.
            context: Its shutdown ends the wait; the default context if None.

        Returns:
            True when the time has come, False after a shutdown or a change of the source of ROS
            time.

        Raises:
            NotInitializedException: The context is not valid.
            ValueError: ``until`` belongs to another clock type.
        """
        if context is None:
            from .utilities import get_default_context

            context = get_default_context()
        if not context.ok():
            raise NotInitializedException
        if until.clock_type != self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        return _Sleep(self, until.nanoseconds, context).run()

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Wait for ``rel_time`` on this clock; see :meth:`sleep_until`."""
        return self.sleep_until(self.now() + rel_time, context)

    def _remaining_s(self, until_ns: int) -> float | None:
        """Return the seconds until the clock shows ``until_ns`` by itself.

        None when only a message can move it.
        """
        if self._override_is_active:
            return None
        return max(0, until_ns - self._now_ns()) / S_TO_NS


class ROSClock(Clock):
    """ROS time: the system's time, or that of a simulation while it is active.

    Lyrical deprecates it in favour of ``Clock(clock_type=ClockType.ROS_TIME)``.
    """

    def __new__(cls) -> Self:
        """Make a clock of ROS time."""
        if since(LYRICAL):
            warnings.warn(
                "Use Clock(clock_type=ClockType.ROS_TIME) instead", DeprecationWarning, stacklevel=2
            )
        return BaseClock.__new__(cls, clock_type=ClockType.ROS_TIME)

    def __repr__(self) -> str:
        kind = "ROSClock" if since(LYRICAL) else "Clock"
        return f"{kind}(clock_type={self._clock_type.name})"


class _Sleep:
    """A wait for a time; a shutdown or a change of the time source ends it early."""

    def __init__(self, clock: Clock, until_ns: int, context: Any) -> None:
        self._clock = clock
        self._until_ns = until_ns
        self._context = context
        self._moved = WakeUp()
        self._source_changed = False

    def run(self) -> bool:
        # Held weakly: nothing has to be undone when the sleep is over.
        self._context.on_shutdown(self._wake)
        # Every move forwards may reach the time; a jump backwards cannot.
        smallest = Duration(nanoseconds=1)
        threshold = JumpThreshold(min_forward=smallest, min_backward=None, on_clock_change=True)
        with self._clock.create_jump_callback(threshold, post_callback=self._on_jump):
            while self._context.ok() and not self._source_changed:
                remaining_s = self._clock._remaining_s(self._until_ns)
                if remaining_s == 0 or self._clock._now_ns() >= self._until_ns:
                    return True
                self._moved.wait(remaining_s)
        return False

    def _wake(self) -> None:
        self._moved.set()

    def _on_jump(self, jump: TimeJump) -> None:
        self._source_changed |= jump.clock_change is not ClockChange.ROS_TIME_NO_CHANGE
        self._moved.set()
