"""Options of displays, which come from the page or a file: wrong ones count as not given."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Options"]

_Choice = TypeVar("_Choice", bound=str)


class Options(Mapping[str, object]):
    """The options by name, and readers that fall back to a default."""

    def __init__(self, values: Mapping[str, object]) -> None:
        self._values = dict(values)

    def __getitem__(self, name: str) -> object:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def number(self, name: str, default: float, low: float, high: float) -> float:
        """A finite number, moved into the range from ``low`` to ``high``."""
        value = self._values.get(name)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return default
        if isinstance(value, float) and math.isnan(value):
            return default
        return float(max(low, min(high, value)))

    def flag(self, name: str, default: bool) -> bool:
        """True or false."""
        value = self._values.get(name)
        return value if isinstance(value, bool) else default

    def choice(self, name: str, choices: tuple[_Choice, ...]) -> _Choice:
        """One of ``choices``; the first is the default."""
        value = self._values.get(name)
        return next((choice for choice in choices if choice == value), choices[0])

    def text(self, name: str, default: str = "") -> str:
        """A text."""
        value = self._values.get(name)
        return value if isinstance(value, str) else default

    def color(self, name: str, default: tuple[int, int, int]) -> tuple[int, int, int]:
        """Red, green and blue from 0 to 255: a list of three numbers."""
        value = self._values.get(name)
        if not isinstance(value, (list, tuple)) or len(value) != len(default):
            return default
        if not all(isinstance(part, (int, float)) and not math.isnan(part) for part in value):
            return default
        red, green, blue = (int(max(0, min(255, part))) for part in value)
        return red, green, blue
