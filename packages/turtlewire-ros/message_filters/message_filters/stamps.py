"""The stamps of messages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.time import Time

if TYPE_CHECKING:
    from rclpy.impl.rcutils_logger import RcutilsLogger

_HEADERLESS = (
    "can not use message filters messages without timestamp infomation when "
    '"allow_headerless" is disabled. auto assign ROSTIME to headerless '
    "messages once enabling constructor option of "
    '"allow_headerless".'
)


def stamp_of(message: Any, *, allow_headerless: bool, logger: RcutilsLogger) -> Time | None:
    """Return the stamp of a message.

    Args:
        message: A message with or without a ``header``.
        allow_headerless: Give messages without a stamp the present time.
        logger: Warns if they are not allowed, at most every five seconds.

    Returns:
        The time; None to drop the message.
    """
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    if stamp is None:
        if allow_headerless:
            return Clock(clock_type=ClockType.ROS_TIME).now()
        logger.warning(_HEADERLESS, throttle_duration_sec=5.0)
        return None
    return stamp if hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)


def nanoseconds(time: Duration | float) -> int:
    """Convert a Duration, or a number of seconds, to nanoseconds."""
    return (time if isinstance(time, Duration) else Duration(seconds=time)).nanoseconds
