"""Constants that other modules share."""

#: Nanoseconds of a second.
S_TO_NS = 1_000_000_000
