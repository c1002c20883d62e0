"""QoS on the command line."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ros2cli.arguments import add_arguments, argument, positive_float, unsigned_int
from ros2cli.json_lines import remark_printer

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile
    from turtlewire.wire.base import Graph

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


def add_qos_arguments(
    parser: argparse.ArgumentParser,
    entity_type: str,
    default_profile_str: str = "default",
    extra_message: str = "",
) -> None:
    """Add ``--qos-profile``, ``--qos-depth`` and the other policies.

    Args:
        parser: The parser.
        entity_type: The kind of endpoint, as a word of the help.
        default_profile_str: Name of the profile that is used without options, for the help.
        extra_message: More text for the help.
    """
    title = f"QoS to {entity_type} with (default: {default_profile_str}){extra_message}"
    add_arguments(parser.add_argument_group(title), QOS_ARGUMENTS)


def choose_qos(node: Any, topic_name: str, qos_args: argparse.Namespace) -> QoSProfile:
    """Return the profile that the options describe, or one that matches all publishers.

    Args:
        node: A node of rclpy, or an object whose attribute ``node`` is one.
        topic_name: Full name of the topic.
        qos_args: The command line, with the arguments of `add_qos_arguments`.
    """
    if asked_for(qos_args):
        return with_options(qos_args, "sensor_data")
    graph = getattr(node, "node", node).context.wire.graph
    # The command lines of other packages have no `--json`.
    remark = remark_printer(as_json=getattr(qos_args, "json", False))
    return matching_publishers(graph, topic_name, remark)


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
    # The presets are shared, so callers must not change them.
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
    # As in ROS 2, a latched topic keeps at least one message.
    elif texts["durability"] == "transient_local" and profile.depth == 0:
        profile.depth = 1
    if lease is not None:
        profile.liveliness_lease_duration = Duration(seconds=lease)


def profile_configure_short_keys(
    profile: QoSProfile | None = None,
    reliability: str | None = None,
    durability: str | None = None,
    depth: int | None = None,
    history: str | None = None,
    liveliness: str | None = None,
    liveliness_lease_duration_s: float | None = None,
) -> None:
    """Change a profile by the names of policies on a command line.

    Raises:
        ValueError: ``profile`` is None, or a policy has no such value.
    """
    if profile is None:
        raise ValueError("expected a profile to change, got None")
    texts = {"reliability": reliability, "durability": durability, "history": history}
    configure(profile, {**texts, "liveliness": liveliness}, depth, liveliness_lease_duration_s)


def qos_profile_from_short_keys(
    preset_profile: str,
    reliability: str | None = None,
    durability: str | None = None,
    depth: int | None = None,
    history: str | None = None,
    liveliness: str | None = None,
    liveliness_lease_duration_s: float | None = None,
) -> QoSProfile:
    """Return a named profile, changed by the names of policies on a command line.

    Raises:
        ValueError: A profile or policy value does not exist.
    """
    profile = preset(preset_profile)
    profile_configure_short_keys(
        profile, reliability, durability, depth, history, liveliness, liveliness_lease_duration_s
    )
    return profile


def matching_publishers(
    graph: Graph, topic: str, remark: Callable[[str], None] = print
) -> QoSProfile:
    """Return a profile that matches all publishers of a topic, as strict as they allow.

    Args:
        graph: Where they are known.
        topic: Full name of the topic.
        remark: Prints that the publishers offer different policies.
    """
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
        remark(_fallback("QoSReliabilityPolicy.RELIABLE", "QoSReliabilityPolicy.BEST_EFFORT"))
    latched = sum(end.qos.durability == Durability.TRANSIENT_LOCAL for end in ends)
    if latched == len(ends):
        profile.durability = qos.DurabilityPolicy.TRANSIENT_LOCAL
    elif latched:
        remark(_fallback("QoSDurabilityPolicy.TRANSIENT_LOCAL", "QoSDurabilityPolicy.VOLATILE"))
    return profile


def _fallback(offered: str, used: str) -> str:
    return (
        f"Some, but not all, publishers are offering {offered}. "
        f"Falling back to {used} as it will connect to all publishers"
    )
