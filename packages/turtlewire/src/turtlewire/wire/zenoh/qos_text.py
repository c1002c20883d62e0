"""A QoS in the notation of liveliness tokens.

``<reliability>:<durability>:<history>,<depth>:<deadline>:<lifespan>:<liveliness>,<lease>`` with
numbers of rmw, durations as ``<s>,<ns>``, and nothing where a value is rmw_zenoh's default.
"""

from __future__ import annotations

from turtlewire.wire.qos import (
    INFINITE_NS,
    Durability,
    History,
    Liveliness,
    QoS,
    Reliability,
)

__all__ = ["adapted", "format_qos", "parse_qos"]

#: rmw_zenoh's own default, and what a depth of 0 means there.
_DEFAULT_DEPTH = 42

_SECOND = 1_000_000_000
_FOREVER = divmod(INFINITE_NS, _SECOND)
_PARTS = 6


def adapted(qos: QoS) -> QoS:
    """Return a QoS with rmw_zenoh's defaults in place of system defaults and a depth of 0.

    Best-available policies stay, as in rmw_zenoh: every QoS matches there, so there is nothing to
    choose. They act like best effort and volatile.
    """
    return qos._replace(
        history=qos.history or History.KEEP_LAST,
        depth=qos.depth or _DEFAULT_DEPTH,
        reliability=qos.reliability or Reliability.RELIABLE,
        durability=qos.durability or Durability.VOLATILE,
        liveliness=qos.liveliness or Liveliness.AUTOMATIC,
    )


def format_qos(qos: QoS) -> str:
    """Return the text of an adapted QoS in a token."""
    history = _number(qos.history, History.KEEP_LAST)
    liveliness = _number(qos.liveliness, Liveliness.AUTOMATIC)
    return ":".join(
        (
            _number(qos.reliability, Reliability.RELIABLE),
            _number(qos.durability, Durability.VOLATILE),
            f"{history},{_number(qos.depth, _DEFAULT_DEPTH)}",
            _duration(qos.deadline_ns),
            _duration(qos.lifespan_ns),
            f"{liveliness},{_duration(qos.liveliness_lease_ns)}",
        )
    )


def _number(value: int, default: int) -> str:
    return "" if value == default else str(int(value))


def _duration(nanoseconds: int) -> str:
    parts = divmod(nanoseconds or INFINITE_NS, _SECOND)
    return ",".join(_number(part, default) for part, default in zip(parts, _FOREVER, strict=True))


def parse_qos(text: str) -> QoS:
    """Read the text of a QoS in a token.

    Raises:
        ValueError: ``text`` is not a QoS string of a token.
    """
    parts = [part.split(",") for part in text.split(":")]
    if len(parts) < _PARTS:
        raise ValueError(f"a QoS has {_PARTS} parts, this one {len(parts)}: {text!r}")
    [reliability], [durability], [history, depth], deadline, lifespan, liveliness = parts[:_PARTS]
    return QoS(
        history=History(_value(history, History.KEEP_LAST)),
        depth=_value(depth, _DEFAULT_DEPTH),
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
