"""The common base of point clouds and scans, and colours from values."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from turtlewire_view.displays.content import Content, Display, Output, Removal

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire_view.displays.options import DisplayOptions

__all__ = [
    "PointsDisplay",
    "by_axis",
    "by_value",
    "flat",
    "moved",
    "rainbow",
]


def by_value(
    values: NDArray[Any], options: DisplayOptions, bounds: tuple[float, float] | None = None
) -> NDArray[np.uint8]:
    """Colours of values, as ``(n, 4)``: RViz's rainbow, or from one colour to another.

    Options: ``min`` and ``max`` bound the values unless ``autocompute_bounds``; ``rainbow``,
    ``invert_rainbow``; ``min_color`` and ``max_color`` without the rainbow.

    Args:
        values: Any numbers.
        options: The user's choices.
        bounds: Replace the options that bound the values.
    """
    if bounds is None and not options.flag("autocompute_bounds"):
        bounds = (options.number("min"), options.number("max"))
    place = _place(values, bounds)
    if not options.flag("rainbow"):
        return _ramp(place, options)
    return rainbow(place if options.flag("invert_rainbow") else 1.0 - place)


def by_axis(places: NDArray[np.float64], options: DisplayOptions) -> NDArray[np.uint8]:
    """Colours of places ``(n, 3)`` by one coordinate, as ``(n, 4)``.

    Options: ``axis``; ``axis_min`` and ``axis_max`` bound it unless ``autocompute_axis``.
    """
    bounds = None
    if not options.flag("autocompute_axis"):
        bounds = (options.number("axis_min"), options.number("axis_max"))
    values = places[:, "xyz".index(options.text("axis"))]
    return rainbow(1.0 - _place(values, bounds))


def flat(count: int, color: tuple[int, int, int]) -> NDArray[np.uint8]:
    """Return the same colour ``count`` times, as ``(n, 4)``."""
    return np.tile(np.array([*color, 255], dtype=np.uint8), (count, 1))


def rainbow(place: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return RViz's rainbow: violet at 0, then blue and green, red at 1."""
    scaled = place * 5 + 1
    segment = np.floor(scaled).astype(np.int64)
    rest = scaled - segment
    rest = np.where(segment % 2 == 0, 1.0 - rest, rest)
    level = 1.0 - rest
    zero, one = np.zeros_like(level), np.ones_like(level)
    segments = [segment <= 1, segment == 2, segment == 3, segment == 4]
    red = np.select(segments, [level, zero, zero, level], one)
    green = np.select(segments, [zero, level, one, one], level)
    blue = np.select(segments, [one, one, level, zero], zero)
    return _bytes(np.stack([red, green, blue], axis=1))


def _ramp(place: NDArray[np.float64], options: DisplayOptions) -> NDArray[np.uint8]:
    low = np.array(options.color("min_color"), dtype=np.float64) / 255
    high = np.array(options.color("max_color"), dtype=np.float64) / 255
    return _bytes(low + (high - low) * place[:, None])


def _place(values: NDArray[Any], bounds: tuple[float, float] | None) -> NDArray[np.float64]:
    """Scale values between their bounds to 0..1; values that are not finite become 0.

    Args:
        values: Any numbers.
        bounds: Least and greatest value; None for the values' own.
    """
    numbers = values.astype(np.float64)
    finite = numbers[np.isfinite(numbers)]
    if bounds is None:
        low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
    else:
        low, high = bounds
    if not high > low:
        high = low + 1.0
    with np.errstate(over="ignore", invalid="ignore"):
        place = (numbers - low) / (high - low)
    result: NDArray[np.float64] = np.clip(np.nan_to_num(place, nan=0.0), 0.0, 1.0)
    return result


def _bytes(rgb: NDArray[np.float64]) -> NDArray[np.uint8]:
    rgba = np.full((len(rgb), 4), 255, dtype=np.uint8)
    rgba[:, :3] = np.rint(rgb * 255)
    return rgba


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
