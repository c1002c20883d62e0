"""A link of the tree: the pose of a child frame in its parent, over time or static."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from turtlewire.tf.plain.rules import ENGINE, Rules
from turtlewire.tf.plain.status import LookupStatus

if TYPE_CHECKING:
    from turtlewire.geometry.poses import Pose

MOST_SENDERS = 16
"""A link with more senders forgets the one that has been silent longest."""

MOST_PER_STAMP = 1000
"""Beyond this many values of one stamp only the first, the last and the count are kept."""


class PoseSample(NamedTuple):
    """One pose of the child in ``parent``."""

    parent: str
    pose: Pose


class LinkSamples:
    """The data of one child frame: a static pose, or samples in order of time.

    Samples of one stamp are in order of arrival.
    """

    def __init__(self, *, static: bool, rules: Rules = ENGINE) -> None:
        self.static = static
        self.rules = rules
        #: (name, parent) -> number of samples, newest stamp; the last sender is last.
        self.senders: dict[tuple[str, str], list[int]] = {}
        self.fixed: PoseSample | None = None
        self.cleared_parent = ""  # of a static link that was cleared
        self.stamps: list[int] = []
        self.samples: list[PoseSample] = []
        self.dropped: dict[int, int] = {}  # by flooded stamp

    @property
    def has_data(self) -> bool:
        """True if the link has a pose at any time."""
        return bool(self.samples) or self.fixed is not None

    @property
    def parent(self) -> str:
        """The parent by the newest sample; NO_PARENT without data."""
        newest = self.fixed or (self.samples[-1] if self.samples else None)
        return newest.parent if newest else "NO_PARENT"

    @property
    def last_parent(self) -> str:
        """The parent, of a static link that was cleared its last one; empty without any.

        The search for the latest common time of Lyrical's tf2 still goes that way.
        """
        return self.parent if self.has_data else self.cleared_parent

    @property
    def parents(self) -> set[str]:
        """All parents in the data."""
        history = {sample.parent for sample in self.samples}
        if self.static:
            return {self.last_parent} - {""}
        return history

    @property
    def newest(self) -> int:
        """The newest stamp; 0 for a static link, as in tf2."""
        return self.stamps[-1] if self.stamps else 0

    @property
    def oldest(self) -> int:
        """The oldest stamp; 0 for a static link, as in tf2."""
        return self.stamps[0] if self.stamps else 0

    @property
    def length(self) -> int:
        """Number of values that tf2 would hold."""
        return (1 if self.fixed else len(self.stamps)) + sum(self.dropped.values())

    @property
    def sender(self) -> str:
        """Authority of the last accepted sample."""
        return next(reversed(self.senders), ("no recorded authority", ""))[0]

    @property
    def parent_changes(self) -> int:
        """Number of changes of parent in the kept history."""
        return sum(a.parent != b.parent for a, b in pairwise(self.samples))

    def count_sender(self, name: str, parent: str, stamp: int) -> None:
        """Count an accepted sample for its sender."""
        # Removed and inserted again, because dictionaries keep the order of insertion.
        samples, _ = self.senders.pop((name, parent), [0, 0])
        self.senders[name, parent] = [samples + 1, stamp]
        if len(self.senders) > MOST_SENDERS:
            del self.senders[min(self.senders, key=lambda sender: self.senders[sender][1])]

    def rename_sender(self, name: str, shown: str) -> None:
        """Count what one sender has sent for another name."""
        former, self.senders = self.senders, {}
        for (known, parent), (samples, newest) in former.items():
            sender = (shown if known == name else known, parent)
            others, last = self.senders.pop(sender, [0, newest])
            self.senders[sender] = [others + samples, max(last, newest)]

    def sender_rows(self) -> list[tuple[str, str, int, int]]:
        """(name, parent, samples, newest stamp) of all senders."""
        return [
            (name, parent, samples, newest)
            for (name, parent), (samples, newest) in self.senders.items()
        ]

    def clear(self, *, static_stays: bool) -> None:
        """Forget the samples, and a static pose if it is not to stay."""
        if not static_stays and self.fixed is not None:
            self.cleared_parent = self.fixed.parent
            self.fixed = None
        self.stamps.clear()
        self.samples.clear()
        self.dropped.clear()

    def insert(self, stamp: int, sample: PoseSample, keep: int) -> bool:
        """Add a sample; False if it is too old.

        Samples that are too old by the newest stamp so far are dropped first, as in tf2.
        """
        if self.static:
            self.fixed = sample
            self.cleared_parent = ""
            return True
        if self.stamps:
            limit = self.newest - keep
            self._drop_before(limit)
            if stamp < limit:
                return False
        first, end = bisect_left(self.stamps, stamp), bisect_right(self.stamps, stamp)
        if sample in self.samples[first:end]:
            return True  # tf2 accepts a repetition and stores it once
        if end - first >= MOST_PER_STAMP:
            # A broadcaster with a stopped clock would fill the memory; the newest value is kept.
            self.samples[end - 1] = sample
            self.dropped[stamp] = self.dropped.get(stamp, 0) + 1
        else:
            self.stamps.insert(end, stamp)
            self.samples.insert(end, sample)
        return True

    def _drop_before(self, limit: int) -> None:
        n = bisect_left(self.stamps, limit)
        if n:
            del self.stamps[:n], self.samples[:n]
            self.dropped = {stamp: count for stamp, count in self.dropped.items() if stamp >= limit}

    @property
    def reached(self) -> int | None:
        """The newest stamp; None without samples, as of a static link."""
        return self.stamps[-1] if self.stamps else None

    def read(self, stamp: int | None) -> PoseSample | LookupStatus:
        """The pose at a time (None: the newest), or NO_DATA, FUTURE or PAST."""
        if self.fixed is not None:
            return self.fixed
        if stamp is None and self.samples:
            return self.samples[-1]
        if stamp is None or not self.samples or (len(self.samples) == 1 and stamp != self.newest):
            return LookupStatus.NO_DATA
        # As in tf2, a stamp on the edge of the data needs no neighbour to interpolate with.
        if stamp in {self.newest, self.oldest}:
            return self.samples[0 if stamp == self.oldest != self.newest else -1]
        if not self.oldest < stamp < self.newest:
            return LookupStatus.FUTURE if stamp > self.newest else LookupStatus.PAST
        return self._between(stamp)

    def _between(self, stamp: int) -> PoseSample:
        i = bisect_right(self.stamps, stamp)
        # Poses in different parents cannot be mixed; tf2 takes the older one.
        if self.samples[i - 1].parent != self.samples[i].parent:
            return self.samples[i - 1]
        return self._mix(i - 1, stamp)

    def _mix(self, i: int, stamp: int) -> PoseSample:
        older, newer = self.samples[i], self.samples[i + 1]
        ratio = (stamp - self.stamps[i]) / (self.stamps[i + 1] - self.stamps[i])
        return PoseSample(older.parent, self.rules.interpolate(older.pose, newer.pose, ratio))

    def read_beyond(self, stamp: int | None, limit: int) -> PoseSample | LookupStatus:
        """As `read`, also up to ``limit`` outside of the data.

        The motion between the two outermost samples is continued.
        """
        reading = self.read(stamp)
        if stamp is None or reading not in {LookupStatus.FUTURE, LookupStatus.PAST}:
            return reading
        after = reading == LookupStatus.FUTURE
        i = len(self.samples) - 2 if after else 0
        gap = stamp - self.newest if after else self.oldest - stamp
        same_parent = self.samples[i].parent == self.samples[i + 1].parent
        if gap > limit or not same_parent or self.stamps[i] == self.stamps[i + 1]:
            return reading
        return self._mix(i, stamp)

    def read_newest(self, oldest: int | None) -> PoseSample | LookupStatus:
        """Return the newest pose, unless it is from before a time (None: any is new enough)."""
        if oldest is not None and self.reached is not None and self.reached < oldest:
            return LookupStatus.FUTURE  # the data would have to reach further into the future
        return self.read(None)


def is_nan(pose: Pose) -> bool:
    """Return True if any of the seven numbers is not a number."""
    return any(map(math.isnan, pose))
