"""Constants that other modules share."""

from __future__ import annotations

#: Nanoseconds of a second.
S_TO_NS = 1_000_000_000
