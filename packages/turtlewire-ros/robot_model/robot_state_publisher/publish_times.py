"""The last publish time of each joint, which decides if a joint state is published."""

from __future__ import annotations

from collections.abc import Sequence

_MOST_NAMES = 10_000  # with more joints than this, the names are made up


class PublishTimes:
    """Stamps in nanoseconds of the last joint state that was published, for each joint.

    It is the plain-Python twin of that part of ``turtlewire._native.JointRelay``.
    """

    def __init__(self) -> None:
        self._times: dict[str, int] = {}
        # The names of the last joint state, and its stamp, which are not yet in the dictionary.
        self._names: Sequence[str] = ()
        self._time = 0
        self._last_call = 0

    def moved_back(self, now: int) -> bool:
        """Return True if the clock is behind the time of the last call; notes the time."""
        last, self._last_call = self._last_call, now
        return now < last

    def earliest(self, names: Sequence[str], now: int) -> int:
        """Return the smallest stamp of these joints, 0 for a new one; ``now`` if all are later."""
        # The usual case, and a fast one: layouts are kept, so the same robot gives the same object.
        if names is self._names:
            return min(now, self._time) if names else now
        self._remember()
        return min((now, *(self._times.get(name, 0) for name in names)))

    def published(self, names: Sequence[str], stamp: int) -> None:
        """Note that a joint state of these joints was published."""
        if names is not self._names:
            self._remember()
            self._names = names
        self._time = stamp

    def clear(self) -> None:
        """Forget everything."""
        self._times.clear()
        self._names = ()

    def _remember(self) -> None:
        if len(self._times) > _MOST_NAMES:
            self._times.clear()
        self._times.update(dict.fromkeys(self._names, self._time))
        self._names = ()
