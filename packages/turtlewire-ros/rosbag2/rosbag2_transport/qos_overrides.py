"""QoS profiles by topic from a YAML file, for the recorder and the player."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
)
from turtlewire.bag.qos_yaml import load_yaml
from turtlewire.errors import BagError
from turtlewire.terminal.suggestion import did_you_mean

_POLICIES = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}
_DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")
_OTHERS = ("depth", "avoid_ros_namespace_conventions")
_KEYS = (*_POLICIES, *_DURATIONS, *_OTHERS)


def read_qos_overrides(path: str) -> dict[str, QoSProfile]:
    """Return the profiles in a file, by topic.

    Raises:
        RuntimeError: The file does not hold profiles.
        OSError: The file cannot be read.
    """
    with open(path, encoding="utf-8") as file:
        text = file.read()
    try:
        content = load_yaml(text, path)
    except BagError as error:
        raise RuntimeError(str(error)) from error
    if not isinstance(content, dict):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{path}: expected topics with their profiles, for example `/tf: {{depth: 100}}`"
        )
    return {topic: qos_profile(topic, profile) for topic, profile in content.items()}


def qos_profile(topic: str, policies: Mapping[str, Any]) -> QoSProfile:
    """Return a profile from the words of YAML.

    Args:
        topic: Named in errors.
        policies: ``history``, ``depth``, ``reliability`` and so on; durations as ``sec`` and
            ``nsec``.

    Raises:
        RuntimeError: A key or a word is not known.
    """
    if not isinstance(policies, dict):
        raise RuntimeError(  # noqa: TRY004 - the file is wrong, not the call
            f"{topic}: expected QoS policies, got {policies!r}"
        )
    values: dict[str, Any] = {}
    for key, value in policies.items():
        if key not in _KEYS:
            hint = did_you_mean(str(key), _KEYS)
            lines = f"Unexpected key `{key}` for QoS profile."
            raise RuntimeError(f"{lines}\n{hint}" if hint else lines)
        values[key] = _value(topic, key, value)
    # rmw's default depth.
    if "history" not in values and "depth" not in values:
        values["depth"] = 10
    if values.get("history") == HistoryPolicy.KEEP_LAST and "depth" not in values:
        values["depth"] = 10
    return QoSProfile(**values)


def _value(topic: str, key: str, value: Any) -> Any:
    try:
        if key in _POLICIES:
            return _POLICIES[key].get_from_short_key(value)
        if key in _DURATIONS:
            return Duration(seconds=value.get("sec", 0), nanoseconds=value.get("nsec", 0))
        return bool(value) if key == "avoid_ros_namespace_conventions" else int(value)
    except (AttributeError, KeyError, TypeError, ValueError):
        choices = _POLICIES[key].short_keys() if key in _POLICIES else ()
        known = f"; choose from {', '.join(choices)}" if choices else ""
        raise RuntimeError(f"{topic}: {value!r} is not a valid {key}{known}") from None
