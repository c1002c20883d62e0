"""The policies of a quality of service and their values.

``rclpy.qos`` has them under their public names.
"""

from __future__ import annotations

from enum import IntEnum


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


QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy
