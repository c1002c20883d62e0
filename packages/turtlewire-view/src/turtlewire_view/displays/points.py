"""Base of the displays of points: keeps points for the decay time, within a budget.

As in RViz a decay time of 0 shows the last message alone.
"""

from __future__ import annotations

from collections import deque
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.content import Content, Display, Output, Removal

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

__all__ = ["PointsDisplay", "moved"]

#: At most this many messages are kept, for any decay time.
_MOST_KEPT = 1000


class _Kept(NamedTuple):
    part: str
    expires_ns: int
    size: int


class PointsDisplay(Display):
    """A display whose message is a set of points.

    Options: ``decay_time`` is for how many seconds the points of a message stay.
    """

    replays = True

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._numbers = count()
        self._kept: deque[_Kept] = deque()
        self._came_ns: int | None = None

    def start(self) -> list[Output]:
        """Other options restart the history."""
        gone: list[Output] = [Removal(kept.part) for kept in self._kept]
        self._kept.clear()
        self._came_ns = None
        return gone

    def points(self, message: Any, budget: int, part: str, header: dict[str, Any]) -> Content:
        """Return the points of a message.

        Args:
            message: The message.
            budget: How many points may be sent.
            part: The content's.
            header: What the content's header holds, besides how many points there are.
        """
        raise NotImplementedError

    def _outputs(self, message: Any) -> list[Output]:
        decay = self.options.number("decay_time")
        if not decay:
            return [self.points(message, self.budget, "", {})]
        now = self._clock()
        expected = self._expected(now, decay)
        part = str(next(self._numbers))
        budget = max(1, int(self.budget / expected))
        content = self.points(message, budget, part, {"decay": decay})
        size = len(content.arrays["rgba"])
        self._kept.append(_Kept(part, now + int(decay * 1e9), size))
        return [content, *self._gone(now)]

    def _expected(self, now: int, decay: float) -> float:
        """Estimate the number of messages shown at a time from the last interval."""
        came, self._came_ns = self._came_ns, now
        if came is None:
            return 1.0
        return min(_MOST_KEPT, max(1.0, decay * 1e9 / max(1, now - came)))

    def _gone(self, now: int) -> list[Output]:
        """Remove expired messages, and the oldest beyond the limit of points."""
        gone: list[Output] = []
        total = sum(kept.size for kept in self._kept)
        while len(self._kept) > 1:
            oldest = self._kept[0]
            too_many = total > self.budget or len(self._kept) > _MOST_KEPT
            if not too_many and oldest.expires_ns > now:
                break
            total -= oldest.size
            gone.append(Removal(self._kept.popleft().part))
        return gone


def moved(matrices: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return each point ``(n, 3)`` by its matrix ``(n, 4, 4)``, or all by one ``(1, 4, 4)``."""
    turned: NDArray[np.float64] = np.einsum("nij,nj->ni", matrices[:, :3, :3], points)
    return turned + matrices[:, :3, 3]
