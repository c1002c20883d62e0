"""Finds transforms that are missing from a periodic series: lost in transit, or skipped.

A broadcaster with a timer stamps its transforms one period apart. If some of them get lost, each at
random, the steps between the rest are multiples of that period, and their lengths follow the
geometric distribution. Three other patterns look different, and are not loss: a broadcaster that
has no period, one that is delayed from time to time (few but long gaps), and one whose clock ticks
faster than it publishes (all steps nearly as long).
"""

from __future__ import annotations

from itertools import pairwise
from statistics import fmean, pvariance
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Gaps", "find_gaps"]

#: With fewer steps, random steps look periodic.
_FEWEST_STEPS = 10
#: Stamps of one moment: what a node publishes in one turn.
_ONE_MOMENT_NS = 1_000_000
#: Maximum length of the shortest remaining step, in periods.
_LONGEST_SHORTEST = 6
#: Tolerance of a step, as a fraction of the period; some steps may differ by more.
_TOLERANCE = 0.2
_MISFITS = 0.1
#: A smaller number means that the broadcaster was delayed for a moment.
_LEAST_SHARE = 0.3
#: Minimum fraction of what random loss leaves on average: single steps, gaps, and variance.
_MUCH = 0.4


class Gaps(NamedTuple):
    """The transforms that are missing from a series.

    Attributes:
        share: The part that is missing, 0 to 1.
        period_s: Time between two transforms, if none were missing [s].
        longest_s: The longest step between two transforms that came [s].
    """

    share: float
    period_s: float
    longest_s: float


def find_gaps(stamps_ns: Sequence[int]) -> Gaps | None:
    """Look for transforms that are missing.

    Args:
        stamps_ns: Stamps of a frame's transforms from one publisher [ns], in any order.

    Returns:
        What is missing; None if nothing is, or if the stamps have no rhythm.
    """
    steps = [
        later - earlier
        for earlier, later in pairwise(sorted(stamps_ns))
        if later - earlier > _ONE_MOMENT_NS
    ]
    if len(steps) < _FEWEST_STEPS:
        return None
    for divisor in range(1, _LONGEST_SHORTEST + 1):
        turns = _turns(steps, min(steps) / divisor)
        if turns is not None:
            break
    else:
        return None
    share = 1.0 - len(turns) / sum(turns)
    if share < _LEAST_SHARE or not _is_random(turns, share):
        return None
    return Gaps(share, sum(steps) / sum(turns) / 1e9, max(steps) / 1e9)


def _turns(steps: Sequence[int], period: float) -> list[int] | None:
    """Return each step in periods, shortest first; None if they are not multiples.

    The period is corrected with each step, so that it is good enough for the long ones.
    """
    turns: list[int] = []
    total = misfits = 0
    for step in sorted(steps):
        turn = max(1, round(step / period))
        misfits += abs(step / period - turn) > _TOLERANCE
        turns.append(turn)
        total += step
        period = total / sum(turns)
    return turns if misfits <= _MISFITS * len(steps) else None


def _is_random(turns: Sequence[int], share: float) -> bool:
    """Return True if random loss explains the number and the lengths of the gaps."""
    mean = fmean(turns)
    singles = sum(turn == 1 for turn in turns)
    gaps = len(turns) - singles
    return (
        singles >= int(_MUCH * (1.0 - share) * len(turns))
        and gaps >= _MUCH * share * len(turns)
        and pvariance(turns, mean) >= _MUCH * mean * (mean - 1.0)
    )
