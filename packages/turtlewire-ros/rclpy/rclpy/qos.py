"""Quality of service: profiles, presets and a compatibility check."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any, NamedTuple

from turtlewire.distro import KILTED, since
from turtlewire.wire import qos as wire_qos

from ._qos.policies import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPolicyEnum,
    QoSPolicyKind,
    QoSReliabilityPolicy,
    ReliabilityPolicy,
    qos_policy_name_from_kind,
)
from ._rclpy_pybind11 import rmw_qos_profile_t
from .duration import Duration
from .impl.hints import checked_property, require, with_hint

__all__ = [
    "DeadlineBestAvailable",
    "DurabilityPolicy",
    "HistoryPolicy",
    "InvalidQoSProfileException",
    "LivelinessLeaseDurationeBestAvailable",
    "LivelinessPolicy",
    "QoSCheckCompatibleResult",
    "QoSCompatibility",
    "QoSDurabilityPolicy",
    "QoSHistoryPolicy",
    "QoSLivelinessPolicy",
    "QoSPolicyEnum",
    "QoSPolicyKind",
    "QoSPresetProfiles",
    "QoSProfile",
    "QoSReliabilityPolicy",
    "ReliabilityPolicy",
    "qos_check_compatible",
    "qos_policy_name_from_kind",
    "qos_profile_action_status_default",
    "qos_profile_best_available",
    "qos_profile_default",
    "qos_profile_parameter_events",
    "qos_profile_parameters",
    "qos_profile_rosout_default",
    "qos_profile_sensor_data",
    "qos_profile_services_default",
    "qos_profile_system_default",
    "qos_profile_unknown",
]


class InvalidQoSProfileException(Exception):
    """A profile has no value for a required policy."""

    def __init__(self, message: str = "") -> None:
        # Kilted dropped the words before the reason.
        super().__init__(*((message,) if since(KILTED) else ("Invalid QoSProfile", message)))


_UNSPECIFIED = Duration()
_INFINITE_NS = wire_qos.INFINITE_NS
#: rmw's mark for "as strict as the other side allows".
DeadlineBestAvailable = Duration(nanoseconds=_INFINITE_NS - 1)
LivelinessLeaseDurationeBestAvailable = DeadlineBestAvailable  # ROS 2's spelling
#: The policies of a profile and their values unless given.
_DEFAULTS: dict[str, Any] = {
    "history": HistoryPolicy.KEEP_LAST,
    "depth": 10,
    "reliability": ReliabilityPolicy.RELIABLE,
    "durability": DurabilityPolicy.VOLATILE,
    "lifespan": _UNSPECIFIED,
    "deadline": _UNSPECIFIED,
    "liveliness": LivelinessPolicy.SYSTEM_DEFAULT,
    "liveliness_lease_duration": _UNSPECIFIED,
    "avoid_ros_namespace_conventions": False,
}


class QoSProfile:
    """The quality of service that a publisher offers or a subscription requests.

    Mutable. In Jazzy, all arguments are keywords and none is None; from Kilted on, None is the
    default.

    Args:
        history: Needs ``depth`` when it is KEEP_LAST; KEEP_LAST when omitted.
        depth: Samples kept; needed unless ``history`` is given.
        reliability: RELIABLE unless given.
        durability: VOLATILE unless given.
        lifespan: How long a sample is valid; unlimited unless given.
        deadline: Longest expected time between samples; unlimited unless given.
        liveliness: SYSTEM_DEFAULT unless given.
        liveliness_lease_duration: How long a publisher counts as alive without a sign; unlimited
            unless given.
        avoid_ros_namespace_conventions: Use the topic name without ROS 2's prefix.

    Raises:
        InvalidQoSProfileException: Neither history nor depth, or KEEP_LAST without depth.
        ValueError: A negative depth or an unknown policy value.
    """

    __slots__ = tuple(f"_{policy}" for policy in _DEFAULTS)
    __hash__ = None  # type: ignore[assignment]  # mutable

    def __init__(
        self,
        history: HistoryPolicy | int | None = None,
        depth: int | None = None,
        reliability: ReliabilityPolicy | int | None = None,
        durability: DurabilityPolicy | int | None = None,
        lifespan: Duration | None = None,
        deadline: Duration | None = None,
        liveliness: LivelinessPolicy | int | None = None,
        liveliness_lease_duration: Duration | None = None,
        avoid_ros_namespace_conventions: bool | None = None,
    ) -> None:
        values = (
            history,
            depth,
            reliability,
            durability,
            lifespan,
            deadline,
            liveliness,
            liveliness_lease_duration,
            avoid_ros_namespace_conventions,
        )
        policies = zip(_DEFAULTS, values, strict=True)
        self._set({policy: value for policy, value in policies if value is not None})

    if not (TYPE_CHECKING or since(KILTED)):

        def __init__(self, **kwargs: Any) -> None:
            if not all(key in _DEFAULTS for key in kwargs):
                unknown = ", ".join(sorted(kwargs.keys() - _DEFAULTS.keys()))
                raise with_hint(
                    AssertionError(f"Invalid arguments passed to constructor: {kwargs.keys()!r}"),
                    f"A QoSProfile has no {unknown}; it has {', '.join(_DEFAULTS)}",
                )
            self._set(kwargs)

    def _set(self, policies: dict[str, Any]) -> None:
        if "history" not in policies and "depth" not in policies:
            raise InvalidQoSProfileException("History and/or depth settings are required.")
        if "depth" not in policies and policies["history"] == HistoryPolicy.KEEP_LAST:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        for policy, default in _DEFAULTS.items():
            setattr(self, policy, policies.get(policy, default))

    history: HistoryPolicy = checked_property(
        "history", HistoryPolicy, "History policy: which samples are kept."
    )

    @property
    def depth(self) -> int:
        """Number of samples that KEEP_LAST keeps."""
        return self._depth

    @depth.setter
    def depth(self, value: int) -> None:
        require(value, int)
        if value < 0:
            raise ValueError("history depth must be greater than or equal to zero")
        if value == 0 and self.history == HistoryPolicy.KEEP_LAST:
            import warnings

            warnings.warn(
                "A zero depth with KEEP_LAST doesn't make sense; no data could be stored. This "
                "will be interpreted as SYSTEM_DEFAULT",
                stacklevel=3,
            )
        self._depth = value

    reliability: ReliabilityPolicy = checked_property(
        "reliability", ReliabilityPolicy, "Reliability policy: RELIABLE sends lost samples again."
    )
    durability: DurabilityPolicy = checked_property(
        "durability",
        DurabilityPolicy,
        "Durability policy: TRANSIENT_LOCAL sends earlier samples to late joiners.",
    )
    lifespan: Duration = checked_property(
        "lifespan", Duration, "Time for which a sample is valid; zero means unlimited."
    )
    deadline: Duration = checked_property(
        "deadline", Duration, "Longest expected time between samples; zero means unlimited."
    )
    liveliness: LivelinessPolicy = checked_property(
        "liveliness",
        LivelinessPolicy,
        "Liveliness policy: who asserts that a publisher is alive.",
    )
    liveliness_lease_duration: Duration = checked_property(
        "liveliness_lease_duration",
        Duration,
        "Time for which a publisher counts as alive after a sign of life; zero means unlimited.",
    )
    avoid_ros_namespace_conventions: bool = checked_property(
        "avoid_ros_namespace_conventions",
        bool,
        "True if the topic name goes out without ROS 2's prefix.",
    )

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, QoSProfile):
            return NotImplemented
        return all(getattr(self, field) == getattr(other, field) for field in _DEFAULTS)

    def __str__(self) -> str:
        fields = ", ".join(f"{field}={getattr(self, field)}" for field in _DEFAULTS)
        return f"{type(self).__name__}({fields})"

    def get_c_qos_profile(self) -> rmw_qos_profile_t:
        """Return the policies as the structure of ROS 2's C library."""
        return rmw_qos_profile_t(**{field: getattr(self, field) for field in _DEFAULTS})

    def to_wire(self) -> wire_qos.QoS:
        """Convert to what the middleware takes."""
        return wire_qos.QoS(
            history=wire_qos.History(self.history),
            depth=self.depth,
            reliability=wire_qos.Reliability(self.reliability),
            durability=wire_qos.Durability(self.durability),
            deadline_ns=self.deadline.nanoseconds,
            lifespan_ns=self.lifespan.nanoseconds,
            liveliness=wire_qos.Liveliness(self.liveliness),
            liveliness_lease_ns=self.liveliness_lease_duration.nanoseconds,
            avoid_ros_namespace_conventions=self.avoid_ros_namespace_conventions,
        )

    @classmethod
    def from_wire(cls, qos: wire_qos.QoS) -> QoSProfile:
        """Convert from what the middleware reports of an endpoint."""
        return cls(
            history=HistoryPolicy(qos.history),
            depth=qos.depth,
            reliability=ReliabilityPolicy(qos.reliability),
            durability=DurabilityPolicy(qos.durability),
            deadline=Duration(nanoseconds=qos.deadline_ns),
            lifespan=Duration(nanoseconds=qos.lifespan_ns),
            liveliness=LivelinessPolicy(qos.liveliness),
            liveliness_lease_duration=Duration(nanoseconds=qos.liveliness_lease_ns),
            avoid_ros_namespace_conventions=qos.avoid_ros_namespace_conventions,
        )


qos_profile_unknown = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    depth=0,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_default = QoSProfile(depth=10)
qos_profile_system_default = QoSProfile(
    history=HistoryPolicy.SYSTEM_DEFAULT,
    depth=0,
    reliability=ReliabilityPolicy.SYSTEM_DEFAULT,
    durability=DurabilityPolicy.SYSTEM_DEFAULT,
)
qos_profile_sensor_data = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default = QoSProfile(depth=10)
qos_profile_parameters = QoSProfile(depth=1000)
qos_profile_parameter_events = QoSProfile(depth=1000)
qos_profile_best_available = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_AVAILABLE,
    durability=DurabilityPolicy.BEST_AVAILABLE,
    deadline=DeadlineBestAvailable,
    liveliness=LivelinessPolicy.BEST_AVAILABLE,
    liveliness_lease_duration=LivelinessLeaseDurationeBestAvailable,
)
#: A tool that starts late still gets the last ten seconds.
qos_profile_rosout_default = QoSProfile(
    depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(seconds=10)
)
qos_profile_action_status_default = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class QoSPresetProfiles(Enum):
    """The presets by name."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available
    if since(KILTED):
        ROSOUT_DEFAULT = qos_profile_rosout_default

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return all presets as short keys, for example ``sensor_data``."""
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return the profile of a short key.

        Raises:
            KeyError: The preset does not exist.
        """
        return cls[name.upper()].value


class QoSCompatibility(Enum):
    """The result of comparing the QoS of a publisher and a subscription."""

    OK = 0
    WARNING = 1
    ERROR = 2


class QoSCheckCompatibleResult(NamedTuple):
    """The answer of :func:`qos_check_compatible`."""

    compatibility: QoSCompatibility
    reason: str


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> QoSCheckCompatibleResult:
    """Check whether a publisher and a subscription with these profiles would match.

    Returns:
        ``(compatibility, reason)``; the reason is empty when they do, and a WARNING means that a
        profile leaves it open.
    """
    from ._qos.compatibility import check

    level, reason = check(publisher_qos, subscription_qos)
    return QoSCheckCompatibleResult(QoSCompatibility(level), reason)
