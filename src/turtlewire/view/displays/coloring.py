"""Colours of points: from their values over RViz's rainbow, from one channel, or all the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from turtlewire.view.displays.options import Options

__all__ = ["flat", "rainbow", "ramp"]


def rainbow(values: NDArray[Any], options: Options) -> NDArray[np.uint8]:
    """RViz's rainbow, from red at the least value over green and blue to violet, as ``(n, 4)``.

    Options: ``min`` and ``max`` bound the values unless ``autocompute_bounds``, which is the
    default; ``invert_rainbow``.
    """
    place = _place(values, options)
    if not options.flag("invert_rainbow", False):
        place = 1.0 - place
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


def ramp(values: NDArray[Any], options: Options) -> NDArray[np.uint8]:
    """From ``min_color`` to ``max_color`` as ``(n, 4)``."""
    place = _place(values, options)[:, None]
    low = np.array(options.color("min_color", (0, 0, 0)), dtype=np.float64) / 255
    high = np.array(options.color("max_color", (255, 255, 255)), dtype=np.float64) / 255
    return _bytes(low + (high - low) * place)


def flat(count: int, color: tuple[int, int, int]) -> NDArray[np.uint8]:
    """The same colour ``count`` times, as ``(n, 4)``."""
    return np.tile(np.array([*color, 255], dtype=np.uint8), (count, 1))


def _place(values: NDArray[Any], options: Options) -> NDArray[np.float64]:
    """Where values lie between their bounds, from 0 to 1; what is not finite lies at 0."""
    numbers = values.astype(np.float64)
    finite = numbers[np.isfinite(numbers)]
    if options.flag("autocompute_bounds", True):
        low, high = (finite.min(), finite.max()) if len(finite) else (0.0, 0.0)
    else:
        low, high = options.number("min", 0.0, -1e30, 1e30), options.number("max", 1.0, -1e30, 1e30)
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
