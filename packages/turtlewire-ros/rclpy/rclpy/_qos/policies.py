"""The policies of a quality of service and their values.

``rclpy.qos`` has them under their public names.
"""

from __future__ import annotations

import warnings
from enum import IntEnum

from turtlewire.distro import LYRICAL, since


class QoSPolicyKind(IntEnum):
    """The policies, as events name them."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64
    DEPTH = 128
    LIVELINESS_LEASE_DURATION = 256
    AVOID_ROS_NAMESPACE_CONVENTIONS = 512


def qos_policy_name_from_kind(policy_kind: QoSPolicyKind | int) -> str:
    """Return the name of a policy, for example ``RELIABILITY``."""
    return str(QoSPolicyKind(policy_kind).name)


class QoSPolicyEnum(IntEnum):
    """Base of the policies' values; the short keys are what parameters and the command line use."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return all values as short keys, for example ``["system_default", "keep_last", …]``."""
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Return the value of a short key.

        Raises:
            KeyError: The key does not exist.
        """
        # As in ROS 2, the number and not the member.
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """This value's short key."""
        return self.name.lower()


class HistoryPolicy(QoSPolicyEnum):
    """History policy: which samples are kept."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3


class ReliabilityPolicy(QoSPolicyEnum):
    """Reliability policy: RELIABLE sends lost samples again."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class DurabilityPolicy(QoSPolicyEnum):
    """Durability policy: TRANSIENT_LOCAL sends earlier samples to late joiners."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4


class LivelinessPolicy(QoSPolicyEnum):
    """Liveliness policy: who asserts that a publisher is alive."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    # 2 was MANUAL_BY_NODE, which ROS 2 removed.
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


class _OldName:
    """A value under the name of rmw's C library, which Lyrical does not have."""

    def __init__(self, old: str, new: str) -> None:
        self.old = old
        self.new = new

    def __get__(self, _: object, policy: type[QoSPolicyEnum]) -> QoSPolicyEnum:
        warnings.warn(
            f"{policy.__name__}.{self.old} is deprecated. "
            f"Use {policy.__name__}.{self.new} instead.",
            stacklevel=2,
        )
        return policy[self.new]


if not since(LYRICAL):
    for _policy in (HistoryPolicy, ReliabilityPolicy, DurabilityPolicy, LivelinessPolicy):
        for _new in _policy.__members__.keys() - {"BEST_AVAILABLE"}:
            _kind = _policy.__name__.removesuffix("Policy").upper()
            if (_kind, _new) == ("LIVELINESS", "UNKNOWN"):
                _kind = "DURABILITY"  # ROS 2's slip
            _old = f"RMW_QOS_POLICY_{_kind}_{_new}"
            setattr(_policy, _old, _OldName(_old, _new))

QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy
