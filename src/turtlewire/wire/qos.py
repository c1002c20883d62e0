"""Quality of service, with the numbers of ROS 2's rmw."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

__all__ = ["INFINITE_NS", "Durability", "History", "Liveliness", "QoS", "Reliability"]

#: A duration that never ends, in nanoseconds.
INFINITE_NS = 0x7FFF_FFFF_FFFF_FFFF


class History(IntEnum):
    """How many samples are kept."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class Reliability(IntEnum):
    """Whether lost samples are sent again."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Durability(IntEnum):
    """Whether late joiners receive earlier samples."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Liveliness(IntEnum):
    """Who asserts that a writer is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


class QoS(NamedTuple):
    """The quality of service of one endpoint; the default is ROS 2's default profile. Durations are nanoseconds, 0 means unspecified."""

    history: History = History.KEEP_LAST
    depth: int = 10
    reliability: Reliability = Reliability.RELIABLE
    durability: Durability = Durability.VOLATILE
    deadline_ns: int = 0
    lifespan_ns: int = 0
    liveliness: Liveliness = Liveliness.SYSTEM_DEFAULT
    liveliness_lease_ns: int = 0
    avoid_ros_namespace_conventions: bool = False
