"""The kinds of time of clocks and time stamps."""

from enum import IntEnum


class ClockType(IntEnum):
    """ROS time follows ``/clock`` if ``use_sim_time`` is set, else it is the system's time."""

    UNINITIALIZED = 0
    ROS_TIME = 1
    SYSTEM_TIME = 2
    STEADY_TIME = 3
