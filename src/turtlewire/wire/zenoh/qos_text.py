"""A QoS as a liveliness token spells it.

``<reliability>:<durability>:<history>,<depth>:<deadline>:<lifespan>:<liveliness>,<lease>`` with
numbers of rmw, durations as ``<s>,<ns>``, and nothing where a value is rmw_zenoh's default.
"""

from __future__ import annotations

from turtlewire.wire.qos import (
    BEST_AVAILABLE_NS,
    INFINITE_NS,
    Durability,
    History,
    Liveliness,
    QoS,
    Reliability,
)

__all__ = ["DEFAULT_DEPTH", "format_qos", "parse_qos"]

#: rmw_zenoh's own default, and what a depth of 0 means there.
DEFAULT_DEPTH = 42

_SECOND = 1_000_000_000
_FOREVER = divmod(INFINITE_NS, _SECOND)
_PARTS = 6


def format_qos(qos: QoS) -> str:
    """The text of a QoS in a token."""
    history = qos.history or History.KEEP_LAST
    return ":".join(
        (
            _number(qos.reliability or Reliability.RELIABLE, Reliability.RELIABLE),
            _number(qos.durability or Durability.VOLATILE, Durability.VOLATILE),
            _number(history, History.KEEP_LAST)
            + ","
            + _number(qos.depth or DEFAULT_DEPTH, DEFAULT_DEPTH),
            _duration(qos.deadline_ns),
            _duration(qos.lifespan_ns),
            _number(qos.liveliness or Liveliness.AUTOMATIC, Liveliness.AUTOMATIC)
            + ","
            + _duration(qos.liveliness_lease_ns),
        )
    )


def _number(value: int, default: int) -> str:
    return "" if value == default else str(int(value))


def _duration(nanoseconds: int) -> str:
    if nanoseconds in {0, BEST_AVAILABLE_NS}:
        nanoseconds = INFINITE_NS
    parts = divmod(nanoseconds, _SECOND)
    return ",".join(_number(part, default) for part, default in zip(parts, _FOREVER, strict=True))


def parse_qos(text: str) -> QoS:
    """Read the text of a QoS in a token.

    Raises:
        ValueError: It is no such text.
    """
    parts = [part.split(",") for part in text.split(":")]
    if len(parts) < _PARTS:
        raise ValueError(f"a QoS has {_PARTS} parts, this one {len(parts)}: {text!r}")
    [reliability], [durability], [history, depth], deadline, lifespan, liveliness = parts[:_PARTS]
    return QoS(
        history=History(_value(history, History.KEEP_LAST)),
        depth=_value(depth, DEFAULT_DEPTH),
        reliability=Reliability(_value(reliability, Reliability.RELIABLE)),
        durability=Durability(_value(durability, Durability.VOLATILE)),
        deadline_ns=_nanoseconds(deadline),
        lifespan_ns=_nanoseconds(lifespan),
        liveliness=Liveliness(_value(liveliness[0], Liveliness.AUTOMATIC)),
        liveliness_lease_ns=_nanoseconds(liveliness[1:]),
    )


def _value(text: str, default: int) -> int:
    return int(text) if text else default


def _nanoseconds(parts: list[str]) -> int:
    seconds, nanoseconds = (
        _value(part, default) for part, default in zip(parts, _FOREVER, strict=True)
    )
    return seconds * _SECOND + nanoseconds
