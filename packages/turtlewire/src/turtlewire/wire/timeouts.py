"""Converts timeouts for `threading` and for DDS."""

from __future__ import annotations

import threading

from .qos import INFINITE_NS

_LONGEST_NS = int(threading.TIMEOUT_MAX * 1_000_000_000)


def of_threading(timeout_ns: int | None) -> float | None:
    """Convert to seconds; None (no limit) for more than a thread can wait."""
    if timeout_ns is None or timeout_ns >= _LONGEST_NS:
        return None
    return max(timeout_ns, 0) / 1e9


def of_dds(timeout_ns: int | None) -> int:
    """Limit to the range of DDS: from 0 to its infinite duration."""
    return INFINITE_NS if timeout_ns is None else min(max(timeout_ns, 0), INFINITE_NS)
