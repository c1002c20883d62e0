"""Quality of service, with the numbers of ROS 2's rmw."""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum
from typing import Any, NamedTuple

#: A duration that never ends, in nanoseconds.
INFINITE_NS = 0x7FFF_FFFF_FFFF_FFFF

#: A deadline or lease that is to fit those of the endpoints that are there.
BEST_AVAILABLE_NS = INFINITE_NS - 1


class History(IntEnum):
    """History policy: which samples are kept."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class Reliability(IntEnum):
    """Reliability policy: RELIABLE sends lost samples again."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Durability(IntEnum):
    """Durability policy: TRANSIENT_LOCAL sends earlier samples to late joiners."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class Liveliness(IntEnum):
    """The party that asserts that a writer is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


_ALL_BEST_AVAILABLE = {
    "reliability": Reliability.BEST_AVAILABLE,
    "durability": Durability.BEST_AVAILABLE,
    "liveliness": Liveliness.BEST_AVAILABLE,
    "deadline_ns": BEST_AVAILABLE_NS,
    "liveliness_lease_ns": BEST_AVAILABLE_NS,
}


class QoS(NamedTuple):
    """The quality of service of one endpoint.

    The default is ROS 2's default profile. Durations are nanoseconds, 0 means unspecified.
    """

    history: History = History.KEEP_LAST
    depth: int = 10
    reliability: Reliability = Reliability.RELIABLE
    durability: Durability = Durability.VOLATILE
    deadline_ns: int = 0
    lifespan_ns: int = 0
    liveliness: Liveliness = Liveliness.SYSTEM_DEFAULT
    liveliness_lease_ns: int = 0
    avoid_ros_namespace_conventions: bool = False

    @property
    def has_best_available(self) -> bool:
        """True if a policy depends on the existing endpoints."""
        return any(getattr(self, name) == wanted for name, wanted in _ALL_BEST_AVAILABLE.items())


def fit_subscription(qos: QoS, offered: Iterable[QoS]) -> QoS:
    """Choose the best-available policies of a subscription so that it matches all publishers.

    The highest that all of them offer.
    """
    offered = list(offered)
    reliable = all(other.reliability == Reliability.RELIABLE for other in offered)
    transient_local = all(other.durability == Durability.TRANSIENT_LOCAL for other in offered)
    manual = bool(offered) and all(
        other.liveliness == Liveliness.MANUAL_BY_TOPIC for other in offered
    )
    return _filled(
        qos,
        reliability=Reliability.RELIABLE if reliable else Reliability.BEST_EFFORT,
        durability=Durability.TRANSIENT_LOCAL if transient_local else Durability.VOLATILE,
        liveliness=Liveliness.MANUAL_BY_TOPIC if manual else Liveliness.AUTOMATIC,
        deadline_ns=max(
            (other.deadline_ns or INFINITE_NS for other in offered), default=INFINITE_NS
        ),
        liveliness_lease_ns=max(
            (other.liveliness_lease_ns or INFINITE_NS for other in offered), default=INFINITE_NS
        ),
    )


def fit_publisher(qos: QoS, requested: Iterable[QoS]) -> QoS:
    """Choose the best-available policies of a publisher so that it matches all subscriptions.

    The highest level of service.
    """
    requested = list(requested)
    manual = any(other.liveliness == Liveliness.MANUAL_BY_TOPIC for other in requested)
    return _filled(
        qos,
        reliability=Reliability.RELIABLE,
        durability=Durability.TRANSIENT_LOCAL,
        liveliness=Liveliness.MANUAL_BY_TOPIC if manual else Liveliness.AUTOMATIC,
        deadline_ns=min(
            (other.deadline_ns or INFINITE_NS for other in requested), default=INFINITE_NS
        ),
        liveliness_lease_ns=min(
            (other.liveliness_lease_ns or INFINITE_NS for other in requested), default=INFINITE_NS
        ),
    )


def _filled(qos: QoS, **values: Any) -> QoS:
    """``qos`` with the given values where it asks for the best available ones."""
    asked = (name for name, wanted in _ALL_BEST_AVAILABLE.items() if getattr(qos, name) == wanted)
    return qos._replace(**{name: values[name] for name in asked})
