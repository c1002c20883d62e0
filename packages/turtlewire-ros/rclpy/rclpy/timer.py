"""Timers and rates."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from turtlewire.distro import LYRICAL, since
from turtlewire.wake_up import WakeUp

from ._execution.entity import ClosingEntity, EntityHost, Work
from ._rclpy_pybind11 import RCLError
from .clock_type import ClockType
from .exceptions import ROSInterruptException
from .impl.hints import with_hint
from .time import Time

if TYPE_CHECKING:
    from .callback_groups import CallbackGroup
    from .clock import BaseClock, TimeJump
    from .context import Context


class TimerInfo:
    """The times of a call of a timer: when it was due, and when it was made.

    A callback of a timer gets one for the parameter that is annotated with this class.

    Args:
        expected_call_time: Time at which the call was due, in nanoseconds.
        actual_call_time: Time at which it was made, in nanoseconds.
        clock_type: The clock of both.
    """

    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None:
        self._expected_call_time = Time(nanoseconds=expected_call_time, clock_type=clock_type)
        self._actual_call_time = Time(nanoseconds=actual_call_time, clock_type=clock_type)

    @property
    def expected_call_time(self) -> Time:
        """Time at which the call was due."""
        return self._expected_call_time

    @property
    def actual_call_time(self) -> Time:
        """Time at which the call was made."""
        return self._actual_call_time


class BaseTimer(ClosingEntity):
    """Calls ``callback()`` once per period of ``clock``, for the first time after one period.

    When a call comes late, the following ones keep the old rhythm; periods that were missed
    entirely are skipped, never made up for. On a ROS clock that follows ``/clock``, the timer
    follows simulated time, its stops and jumps included.

    Args:
        callback: Called once per period; None raises an error at the first call.
        timer_period_ns: Nanoseconds between calls.
        clock: The clock that it follows.
        on_destroy: Called with the timer after it has been destroyed.
        context: Its context; None uses the default.
        autostart: Whether it runs at once, or waits for :meth:`reset`.
    """

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        timer_period_ns: int,
        clock: BaseClock,
        *,
        on_destroy: Callable[[Any], None] | None = None,
        context: Context | None = None,
        autostart: bool = True,
    ) -> None:
        from .utilities import get_default_context

        if timer_period_ns < 0:
            raise RCLError("failed to create timer: timer period must be non-negative")
        super().__init__(None)
        self._on_destroy = on_destroy
        self.callback = callback
        self._inspected_callback: object = None
        self._info_parameter = ""  # of the inspected callback
        self._context = get_default_context() if context is None else context
        self._clock = clock
        self._period_ns = timer_period_ns
        self._last_call_ns = self._clock._now_ns()
        self._next_call_ns = self._last_call_ns + timer_period_ns
        self._remaining_ns = 0
        self._canceled = not autostart
        self._on_closing: Callable[[], None] | None = None
        self._jump_handle = self._follow_jumps() if clock.clock_type == ClockType.ROS_TIME else None

    @property
    def clock(self) -> BaseClock:
        """The clock that it follows."""
        return self._clock

    @property
    def timer_period_ns(self) -> int:
        """Nanoseconds between calls; a new value counts from the next call on."""
        self._check_usable()
        return self._period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None:
        self._check_usable()
        self._period_ns = int(value)

    def is_ready(self) -> bool:
        """Return True if a call is due."""
        self._check_usable()
        return not self._canceled and self._next_call_ns <= self._clock._now_ns()

    def is_canceled(self) -> bool:
        """Return True if it was cancelled and not reset since."""
        self._check_usable()
        return self._canceled

    def cancel(self) -> None:
        """Make no more calls until :meth:`reset`."""
        self._check_usable()
        self._canceled = True
        self._reschedule(self._clock._now_ns())

    def reset(self) -> None:
        """Start (again): the next call is one period from now."""
        self._check_usable()
        now_ns = self._clock._now_ns()
        self._next_call_ns = now_ns + self._period_ns
        self._canceled = False
        self._reschedule(now_ns)

    def time_since_last_call(self) -> int:
        """Nanoseconds since the last call, or since it was made."""
        self._check_usable()
        return self._clock._now_ns() - self._last_call_ns

    def time_until_next_call(self) -> int | None:
        """Nanoseconds until the next call, negative when it is late, None when it is cancelled."""
        self._check_usable()
        return None if self._canceled else self._next_call_ns - self._clock._now_ns()

    def _delay_ns(self, now_ns: int) -> int | None:
        """Time on the monotonic clock until a look at the timer makes sense.

        None when something else will bring it up.
        """
        if self._canceled:
            return None
        delay_ns = self._next_call_ns - now_ns
        if delay_ns <= 0:
            return 0
        # A message on `/clock` reschedules the timer in `_after_jump`.
        return None if self._clock._override_is_active else delay_ns

    def _reschedule(self, now_ns: int) -> None:
        host = self._serving_host()
        if host is not None:
            host.wait.timers.schedule(self, self._delay_ns(now_ns))

    def _attach(self, host: EntityHost) -> None:
        host.wait.timers.schedule(self, self._delay_ns(self._clock._now_ns()))

    def _detach(self, host: EntityHost) -> None:
        host.wait.timers.discard(self)

    def _take(self) -> Work | None:
        now_ns = self._clock._now_ns()
        if self._canceled:
            return None
        if self._next_call_ns > now_ns:  # its clock went back or has stopped
            self._reschedule(now_ns)
            return None
        due_ns, self._last_call_ns = self._next_call_ns, now_ns
        # From the planned time, so that a late call does not shift the rhythm.
        self._next_call_ns += self._period_ns
        if self._next_call_ns < now_ns:
            self._skip_missed_periods(now_ns)
        self._reschedule(now_ns)
        callback = self.callback
        if callback is None:
            return _missing_callback, ()
        if callback is not self._inspected_callback:
            self._inspected_callback = callback
            self._info_parameter = _parameter_for_info(callback)
        if not self._info_parameter:
            return callback, ()
        return partial(callback, **{self._info_parameter: self._info(due_ns)}), ()

    def _info(self, due_ns: int) -> TimerInfo:
        """Return the times of the call that was just taken."""
        return TimerInfo(
            expected_call_time=due_ns,
            actual_call_time=self._last_call_ns,
            clock_type=self._clock.clock_type,
        )

    def _skip_missed_periods(self, now_ns: int) -> None:
        if self._period_ns == 0:
            self._next_call_ns = now_ns
        else:
            # As in rcl: forward to the next multiple of the period.
            behind_ns = now_ns - self._next_call_ns
            self._next_call_ns += (1 + (behind_ns - 1) // self._period_ns) * self._period_ns

    def _follow_jumps(self) -> Any:
        from .clock import JumpThreshold
        from .duration import Duration

        every_jump = JumpThreshold(
            min_forward=Duration(nanoseconds=1),
            min_backward=Duration(nanoseconds=-1),
            on_clock_change=True,
        )
        return self._clock.create_jump_callback(
            every_jump, pre_callback=self._before_jump, post_callback=self._after_jump
        )

    def _before_jump(self) -> None:
        self._remaining_ns = self._next_call_ns - self._clock._now_ns()

    def _after_jump(self, jump: TimeJump) -> None:
        from .clock import ClockChange

        now_ns = self._clock._now_ns()
        if jump.clock_change in (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED):
            # As in rcl, the timer keeps its remaining time; 0 means that no time has arrived yet.
            if now_ns != 0:
                self._next_call_ns = now_ns + self._remaining_ns
                self._last_call_ns = self._next_call_ns - self._period_ns
        # As in rcl, a jump to before the last call starts a whole period.
        elif now_ns < self._last_call_ns:
            self._last_call_ns = now_ns
            self._next_call_ns = now_ns + self._period_ns
        self._reschedule(now_ns)

    def _close(self) -> None:
        if self._on_closing is not None:
            self._on_closing()
        if self._jump_handle is not None:
            self._jump_handle.unregister()


class Timer(BaseTimer):
    """Calls a callback periodically.

    Made by :meth:`Node.create_timer <rclpy.node.Node.create_timer>`; see :class:`BaseTimer` for the
    rhythm and the other arguments.

    Args:
        callback_group: The group of the timer, if it has one. Up to Kilted, it is required, and
            comes after the callback.
    """

    _ORDER = 0

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        timer_period_ns: int,
        clock: BaseClock,
        *,
        on_destroy: Callable[[Any], None] | None = None,
        context: Context | None = None,
        autostart: bool = True,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        super().__init__(
            callback,
            timer_period_ns,
            clock,
            on_destroy=on_destroy,
            context=context,
            autostart=autostart,
        )
        if callback_group is not None:
            self._enter(callback_group)

    if not (TYPE_CHECKING or since(LYRICAL)):
        __init = __init__

        def __init__(  # in the order of Jazzy and Kilted
            self,
            callback: Callable[[], Any] | None,
            callback_group: CallbackGroup | None,
            timer_period_ns: int,
            clock: BaseClock,
            *,
            context: Context | None = None,
            autostart: bool = True,
            on_destroy: Callable[[Any], None] | None = None,
        ) -> None:
            self.__init(
                callback,
                timer_period_ns,
                clock,
                on_destroy=on_destroy,
                context=context,
                autostart=autostart,
                callback_group=callback_group,
            )


def _parameter_for_info(callback: Callable[..., Any]) -> str:
    """Return the parameter that is annotated with `TimerInfo`; empty without one.

    Annotations may be texts.
    """
    notes: dict[str, object] = getattr(callback, "__annotations__", None) or {}
    for name, note in notes.items():
        if name != "return" and (note is TimerInfo or str(note).endswith("TimerInfo")):
            return name
    return ""


def _missing_callback() -> None:
    hint = (
        "A timer has no callback. Pass the function itself (self.tick), not what it returns "
        "(self.tick())"
    )
    raise with_hint(TypeError("'NoneType' object is not callable"), hint)


class Rate:
    """Sleeps in step with a timer; another thread has to spin the timer's node."""

    def __init__(self, timer: Timer, *, context: Context) -> None:
        self._timer = timer
        self._lock = threading.RLock()
        self._sleeps: set[WakeUp] = set()
        self._has_ticked = False
        self._interrupted = False
        self._destroyed = False
        timer.callback = self._tick
        timer._on_closing = self.destroy
        context.on_shutdown(self._interrupt)

    def sleep(self) -> None:
        """Block until the timer is called, or not at all if it was called since the last sleep.

        So a loop may call ``spin_once`` and then sleep in one thread, as in ROS 2.

        Raises:
            ROSInterruptException: The context was shut down.
            RuntimeError: The rate was destroyed, or this thread is the one that spins: no thread
                would end the sleep.
        """
        host = self._timer._serving_host()
        if host is not None and host.is_spun_by_this_thread():
            raise RuntimeError(
                "Rate cannot sleep in a callback of the executor that serves its timer: it would "
                "never wake up"
            )
        end = WakeUp()
        try:
            with self._lock:
                self._sleeps.add(end)
                if self._has_ticked or self._interrupted or self._destroyed:
                    end.set()
            end.wait()
        finally:
            with self._lock:
                self._sleeps.discard(end)
                if not self._sleeps:
                    self._has_ticked = False
        if self._interrupted:
            raise ROSInterruptException
        if self._destroyed:
            raise RuntimeError("Rate cannot sleep because it has been destroyed")

    def destroy(self) -> None:
        """End all sleeps."""
        with self._lock:
            self._destroyed = True
            self._end_sleeps()

    def _tick(self) -> None:
        with self._lock:
            self._has_ticked = True
            self._end_sleeps()

    def _interrupt(self) -> None:
        with self._lock:
            self._interrupted = True
            self._end_sleeps()

    def _end_sleeps(self) -> None:
        for sleep in self._sleeps:
            sleep.set()
