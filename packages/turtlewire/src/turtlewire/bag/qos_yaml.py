"""The QoS of a recorded topic as rosbag2 writes it to YAML, and back.

Up to metadata version 8 the policies are numbers of rmw, since version 9 words. The ``history`` of
a profile decides which of the two it uses, as in rosbag2.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import yaml

from turtlewire.errors import BagError
from turtlewire.wire.qos import INFINITE_NS, Durability, History, Liveliness, QoS, Reliability

if TYPE_CHECKING:
    from enum import IntEnum

__all__ = ["load_yaml", "profiles_from_yaml", "profiles_to_text", "qos_to_yaml"]

_SECOND = 1_000_000_000
_QOS_SINCE = 4
_WORDS_SINCE = 9
#: Metadata nest five levels.
_DEEPEST = 50
#: From this number of seconds on a duration means "infinite": DDS implementations and versions of
#: ROS 2 have written 2147483647 s and 9223372036 s with various nanoseconds.
_INFINITE_SECONDS = 2_147_483_647


def load_yaml(text: str, where: str) -> Any:
    """Parse YAML with the C loader where it exists (ten times faster).

    Raises:
        BagError: ``text`` is not YAML, or is nested too deeply.
    """
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        _check_depth(text, loader)
        return yaml.load(text, loader)  # noqa: S506 - both loaders are safe ones
    except (yaml.YAMLError, ValueError) as error:  # the latter of a date in no calendar
        reason = str(error).replace("\n", " ")
        raise BagError(f"{where}: not readable as YAML: {reason}") from None


def _check_depth(text: str, loader: Any) -> None:
    """Refuse nesting that would make libyaml's loader overflow the stack and crash."""
    depth = 0
    for event in yaml.parse(text, loader):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > _DEEPEST:
                raise yaml.YAMLError(f"nested more than {_DEEPEST} deep")
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


def profiles_from_yaml(offered: str | list[dict[str, Any]] | None, where: str) -> list[QoS]:
    """Return the profiles of a topic's publishers.

    Args:
        offered: YAML as text (sqlite3, MCAP, metadata up to version 8) or what it holds; empty or
            None where the bag does not say.
        where: Names the place in an error.

    Returns:
        The profiles; policies of unknown names or numbers are rmw's UNKNOWN.

    Raises:
        BagError: ``offered`` is not a list of profiles.
    """
    profiles = load_yaml(offered, where) if isinstance(offered, str) else offered
    try:
        return [_profile(profile) for profile in profiles or ()]
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise BagError(f"{where}: not a list of QoS profiles: {error!r}") from None


def _profile(profile: dict[str, Any]) -> QoS:
    return QoS(
        history=_policy(History, profile["history"]),
        depth=int(profile["depth"]),
        reliability=_policy(Reliability, profile["reliability"]),
        durability=_policy(Durability, profile["durability"]),
        deadline_ns=_nanoseconds(profile["deadline"]),
        lifespan_ns=_nanoseconds(profile["lifespan"]),
        liveliness=_policy(Liveliness, profile["liveliness"]),
        liveliness_lease_ns=_nanoseconds(profile["liveliness_lease_duration"]),
        avoid_ros_namespace_conventions=bool(profile["avoid_ros_namespace_conventions"]),
    )


def profiles_to_text(profiles: Iterable[QoS], version: int) -> str:
    """Profiles as YAML in a text; an empty one without profiles, and before version 4.

    Args:
        profiles: What the publishers of a topic offer.
        version: Of the metadata.
    """
    rows = [qos_to_yaml(qos, version) for qos in profiles if version >= _QOS_SINCE]
    return str(yaml.safe_dump(rows, sort_keys=False)) if rows else ""


def qos_to_yaml(qos: QoS, version: int) -> dict[str, Any]:
    """Return a profile as this version of the metadata writes it: numbers up to 8, then words."""

    def policy(value: IntEnum) -> str | int:
        return value.name.lower() if version >= _WORDS_SINCE else int(value)

    return {
        "history": policy(qos.history),
        "depth": qos.depth,
        "reliability": policy(qos.reliability),
        "durability": policy(qos.durability),
        "deadline": _seconds(qos.deadline_ns),
        "lifespan": _seconds(qos.lifespan_ns),
        "liveliness": policy(qos.liveliness),
        "liveliness_lease_duration": _seconds(qos.liveliness_lease_ns),
        "avoid_ros_namespace_conventions": qos.avoid_ros_namespace_conventions,
    }


def _policy(policies: Any, value: Any) -> Any:
    if isinstance(value, str) and not value.isdecimal():
        return (
            policies[value.upper()] if value.upper() in policies.__members__ else policies.UNKNOWN
        )
    number = int(value)
    return policies(number) if number in {int(policy) for policy in policies} else policies.UNKNOWN


def _nanoseconds(duration: dict[str, Any]) -> int:
    seconds = int(duration["sec"])
    if seconds >= _INFINITE_SECONDS:
        return INFINITE_NS
    return seconds * _SECOND + int(duration["nsec"])


def _seconds(nanoseconds: int) -> dict[str, int]:
    return {"sec": nanoseconds // _SECOND, "nsec": nanoseconds % _SECOND}
