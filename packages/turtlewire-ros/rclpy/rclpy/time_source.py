"""Lets ROS clocks follow ``/clock`` while the parameter ``use_sim_time`` is true."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from .clock import BaseClock
from .clock_type import ClockType
from .parameter import Parameter
from .qos import QoSProfile, ReliabilityPolicy
from .time import Time

if TYPE_CHECKING:
    import rosgraph_msgs.msg
    from rcl_interfaces.msg import SetParametersResult

    from ._node.views import TimeSourceOwner

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"


class TimeSource:
    """Gives the time of ``/clock`` to the clocks that are attached.

    It is 0 until the first message.

    Args:
        node: The node whose parameter decides and who subscribes; another one can be set with
            :meth:`attach_node`.
    """

    def __init__(self, *, node: TimeSourceOwner | None = None) -> None:
        self._node: weakref.ref[TimeSourceOwner] | None = None
        self._clocks: set[BaseClock] = set()
        self._clock_subscription: Any = None
        self._last_time_ns = 0
        self._ros_time_is_active = False
        if node is not None:
            self.attach_node(node)

    @property
    def ros_time_is_active(self) -> bool:
        """True if the clocks follow ``/clock``."""
        return self._ros_time_is_active

    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None:
        if self._ros_time_is_active == enabled:
            return
        self._ros_time_is_active = enabled
        for clock in tuple(self._clocks):
            clock._set_ros_time_is_active(enabled)
        if enabled:
            self._subscribe()
        else:
            self._unsubscribe()

    def attach_node(self, node: TimeSourceOwner) -> None:
        """Let this node's parameter decide; an earlier node is detached."""
        if self._node is not None:
            self.detach_node()
        self._node = weakref.ref(node)
        if not node.has_parameter(USE_SIM_TIME_NAME):
            node.declare_parameter(USE_SIM_TIME_NAME, False)
        parameter = node.get_parameter_or(USE_SIM_TIME_NAME)
        if parameter.type_ is Parameter.Type.BOOL:
            self.ros_time_is_active = parameter.value
        elif parameter.type_ is not Parameter.Type.NOT_SET:
            node.get_logger().error(
                f"Invalid type for parameter '{USE_SIM_TIME_NAME}' {parameter.type_!r} should be "
                "bool"
            )
        node.add_on_set_parameters_callback(self._decide_on_parameters)

    def detach_node(self) -> None:
        """Follow ``/clock`` no longer."""
        self._unsubscribe()
        node = self._attached_node()
        if node is not None:
            node.remove_on_set_parameters_callback(self._decide_on_parameters)
        self._node = None

    def attach_clock(self, clock: BaseClock) -> None:
        """Let a clock follow.

        Raises:
            ValueError: The clock does not use ROS time.
        """
        if not isinstance(clock, BaseClock) or clock.clock_type is not ClockType.ROS_TIME:
            raise ValueError("Only clocks with type ROS_TIME can be attached.")
        # Before the clock becomes active, so that it never shows 0 in between.
        clock.set_ros_time_override(self._last_time())
        clock._set_ros_time_is_active(self._ros_time_is_active)
        self._clocks.add(clock)

    def _attached_node(self) -> TimeSourceOwner | None:
        return None if self._node is None else self._node()

    def _subscribe(self) -> None:
        node = self._attached_node()
        if node is None or self._clock_subscription is not None:
            return
        from rosgraph_msgs.msg import Clock as ClockMsg

        # As in ROS 2: only the newest time matters.
        profile = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._clock_subscription = node.create_subscription(
            ClockMsg, CLOCK_TOPIC, self.clock_callback, profile
        )

    def _unsubscribe(self) -> None:
        subscription, self._clock_subscription = self._clock_subscription, None
        if subscription is not None:
            subscription.destroy()

    def clock_callback(self, msg: rosgraph_msgs.msg.Clock) -> None:
        """Set all clocks to the time of a message."""
        stamp = msg.clock
        if stamp.sec < 0:  # no ROS time; the publisher's mistake must not end this program
            self._warn_of_negative_time(stamp.sec)
            return
        self._last_time_ns = stamp.sec * 1_000_000_000 + stamp.nanosec
        time = self._last_time()
        for clock in tuple(self._clocks):
            clock.set_ros_time_override(time)

    def _warn_of_negative_time(self, seconds: int) -> None:
        node = self._attached_node()
        if node is not None:
            node.get_logger().warning(
                f"Ignoring a negative time on '{CLOCK_TOPIC}' ({seconds} s)",
                throttle_duration_sec=5.0,
            )

    def _last_time(self) -> Time:
        return Time(nanoseconds=self._last_time_ns, clock_type=ClockType.ROS_TIME)

    def _decide_on_parameters(self, parameters: list[Parameter]) -> SetParametersResult:
        from rcl_interfaces.msg import SetParametersResult

        wanted: Any = None
        for parameter in parameters:
            if parameter.name == USE_SIM_TIME_NAME:
                if parameter.type_ is not Parameter.Type.BOOL:
                    return SetParametersResult(
                        successful=False,
                        reason=f"{USE_SIM_TIME_NAME} parameter set to something besides a bool",
                    )
                wanted = parameter.value
        # After the loop: a list that is rejected must change nothing.
        if wanted is not None:
            self.ros_time_is_active = wanted
        return SetParametersResult(successful=True)
