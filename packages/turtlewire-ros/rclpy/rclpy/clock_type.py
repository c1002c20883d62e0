"""Which time a clock or a time stamp means."""

from __future__ import annotations

from enum import IntEnum

__all__ = ["ClockType"]


class ClockType(IntEnum):
    """ROS time follows ``/clock`` if ``use_sim_time`` is set, else it is the system's time."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
