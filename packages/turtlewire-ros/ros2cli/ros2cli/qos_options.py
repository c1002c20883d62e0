"""QoS on the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2cli.arguments import argument
from ros2cli.values import positive_float, unsigned_int

if TYPE_CHECKING:
    import argparse

    from rclpy.qos import QoSProfile
    from turtlewire.wire.base import Graph

__all__ = [
    "QOS_ARGUMENTS",
    "asked_for",
    "configure",
    "matching_publishers",
    "preset",
    "with_options",
]

_POLICIES = ("history", "reliability", "durability", "liveliness")
_PROFILES = (
    *("unknown", "default", "system_default", "sensor_data", "services_default", "parameters"),
    *("parameter_events", "action_status_default", "best_available"),
)
_HISTORY = ("system_default", "keep_last", "keep_all", "unknown")
_RELIABILITY = ("system_default", "reliable", "best_effort", "unknown", "best_available")
_DURABILITY = ("system_default", "transient_local", "volatile", "unknown", "best_available")
_LIVELINESS = ("system_default", "automatic", "manual_by_topic", "unknown", "best_available")


QOS_ARGUMENTS = (
    argument("--qos-profile", choices=_PROFILES, help="Named profile to start from"),
    argument("--qos-depth", metavar="N", type=unsigned_int, help="Length of the queue"),
    argument("--qos-history", choices=_HISTORY, help="Which messages the queue keeps"),
    argument(
        "--qos-reliability", choices=_RELIABILITY, help="Whether lost messages are sent again"
    ),
    argument(
        "--qos-durability", choices=_DURABILITY, help="Whether late joiners get earlier messages"
    ),
    argument("--qos-liveliness", choices=_LIVELINESS, help="How publishers assert liveliness"),
    argument(
        "--qos-liveliness-lease-duration-seconds",
        type=positive_float,
        help="Liveliness lease duration [s]",
    ),
)


def asked_for(args: argparse.Namespace) -> bool:
    """Return True if any of the options was given."""
    return any(value is not None for name, value in vars(args).items() if name.startswith("qos_"))


def with_options(args: argparse.Namespace, default: str) -> QoSProfile:
    """Return the profile that the options describe.

    Args:
        args: The command line.
        default: Name of the default profile.
    """
    profile = preset(args.qos_profile or default)
    texts = {name: getattr(args, f"qos_{name}") for name in _POLICIES}
    configure(profile, texts, args.qos_depth, args.qos_liveliness_lease_duration_seconds)
    return profile


def preset(name: str) -> QoSProfile:
    """Return a copy of a named profile.

    Raises:
        ValueError: The name is unknown.
    """
    from rclpy import qos

    chosen = qos.QoSPresetProfiles.get_from_short_key(name)
    return qos.QoSProfile(
        **{
            name: getattr(chosen, name)
            for name in ("history", "depth", "reliability", "durability", "liveliness")
        }
    )


def configure(
    profile: QoSProfile, texts: dict[str, str | None], depth: int | None, lease: float | None
) -> None:
    """Change a profile.

    Args:
        profile: The profile.
        texts: Names of values by policy: history, reliability, durability, liveliness.
        depth: Length of the queue.
        lease: Seconds of the liveliness lease.

    Raises:
        ValueError: A policy has no value of that name.
    """
    from rclpy import qos
    from rclpy.duration import Duration

    for name, text in texts.items():
        if text is not None:
            kind = getattr(qos, f"{name.title()}Policy")
            setattr(profile, name, kind.get_from_short_key(text))
    if depth is not None:
        profile.depth = depth
    elif texts["durability"] == "transient_local" and profile.depth == 0:
        profile.depth = 1
    if lease is not None:
        profile.liveliness_lease_duration = Duration(seconds=lease)


def matching_publishers(graph: Graph, topic: str) -> QoSProfile:
    """Return a profile that matches all publishers of a topic, as strict as they allow."""
    from rclpy import qos
    from ros2cli.graph import endpoints_of_topic
    from turtlewire.wire.qos import Durability, Reliability

    profile = qos.QoSPresetProfiles.get_from_short_key("sensor_data")
    profile = qos.QoSProfile(
        history=profile.history,
        depth=10,
        reliability=profile.reliability,
        durability=profile.durability,
    )
    ends = endpoints_of_topic(graph, topic, "publisher")
    if not ends:
        return profile
    reliable = sum(end.qos.reliability == Reliability.RELIABLE for end in ends)
    if reliable == len(ends):
        profile.reliability = qos.ReliabilityPolicy.RELIABLE
    elif reliable:
        _say_fallback("QoSReliabilityPolicy.RELIABLE", "QoSReliabilityPolicy.BEST_EFFORT")
    latched = sum(end.qos.durability == Durability.TRANSIENT_LOCAL for end in ends)
    if latched == len(ends):
        profile.durability = qos.DurabilityPolicy.TRANSIENT_LOCAL
    elif latched:
        _say_fallback("QoSDurabilityPolicy.TRANSIENT_LOCAL", "QoSDurabilityPolicy.VOLATILE")
    return profile


def _say_fallback(offered: str, used: str) -> None:
    print(
        f"Some, but not all, publishers are offering {offered}. "
        f"Falling back to {used} as it will connect to all publishers"
    )
