"""Options of displays, and the user's choices; wrong choices are rejected.

The table is ``js/displays/options.json``, from which the page builds its controls: for each kind of
display a list of options, or of the names of further lists.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.web.commands import is_finite_number

__all__ = ["DisplayOptions", "Option", "OptionError", "check_option", "option_table"]

_TABLE = Path(__file__).parent.parent / "page" / "js" / "displays" / "options.json"
_COLOR = re.compile("#[0-9a-fA-F]{6}")
_LONGEST_TEXT = 4096
_LARGEST = 1e30
_Color: TypeAlias = tuple[int, int, int]


class OptionError(ValueError):
    """A value that an option does not take, or no option; the text says what is accepted."""


@dataclass(frozen=True, slots=True)
class Option:
    """One option.

    Attributes:
        name: Its name.
        type: ``number``, ``bool``, ``choice``, ``color``, ``text`` or ``items``: an object with
            ``shown`` and perhaps ``alpha`` or ``max`` for each of a display's named things.
        value: The default.
        low: Least number.
        high: Greatest number.
        choices: What ``choice`` takes.
    """

    name: str
    type: str
    value: object
    low: float = -_LARGEST
    high: float = _LARGEST
    choices: tuple[str, ...] = ()

    def accepts(self, value: object) -> bool:
        """Return True if this is a value of the option."""
        if self.type == "number":
            return is_finite_number(value) and self.low <= value <= self.high
        if self.type == "bool":
            return isinstance(value, bool)
        if self.type == "choice":
            return isinstance(value, str) and value in self.choices
        if self.type == "color":
            return _color_of(value) is not None
        if self.type == "items":
            return isinstance(value, dict) and all(map(_is_item, value.values()))
        return isinstance(value, str) and len(value) <= _LONGEST_TEXT

    def wanted(self) -> str:
        """Describe the accepted values."""
        if self.type == "number":
            least = "" if self.low == -_LARGEST else f" from {self.low:g}"
            most = "" if self.high == _LARGEST else f" to {self.high:g}"
            return "a number" + (least + most if least else most and f" up{most}")
        return {
            "bool": "true or false",
            "choice": f"one of {', '.join(self.choices)}",
            "color": "a colour as #rrggbb or three numbers from 0 to 255",
            "items": "an object of {'shown': true or false, 'alpha': number from 0 to 1} by name",
        }.get(self.type, f"a string of at most {_LONGEST_TEXT} characters")


@cache
def option_table(kind: str) -> Mapping[str, Option]:
    """Return the options of a kind of display, by name."""
    return {option.name: option for option in map(_option, _listed(kind))}


class DisplayOptions(Mapping[str, object]):
    """The user's choices, and readers that fall back to the default.

    Args:
        values: The choices by name.
        kind: The kind of display.

    Raises:
        OptionError: An option does not exist, or a value is not accepted.
    """

    def __init__(self, values: Mapping[str, object], kind: str) -> None:
        self._table = option_table(kind)
        for name, value in values.items():
            check_option(kind, name, value)
        self._values = dict(values)

    def __getitem__(self, name: str) -> object:
        return self._values[name] if name in self._values else self._table[name].value

    def __iter__(self) -> Iterator[str]:
        return iter(self._table)

    def __len__(self) -> int:
        return len(self._table)

    def number(self, name: str) -> float:
        """Return a finite number."""
        value = self[name]
        assert is_finite_number(value)
        return value

    def flag(self, name: str) -> bool:
        """True or false."""
        return self[name] is True

    def text(self, name: str) -> str:
        """Return a text, or the name of a choice."""
        return str(self[name])

    def color(self, name: str) -> _Color:
        """Red, green and blue from 0 to 255."""
        found = _color_of(self[name])
        assert found is not None
        return found


def check_option(kind: str, name: str, value: object) -> None:
    """Check that an option of a display accepts a value.

    Raises:
        OptionError: The option does not exist, or does not accept the value.
    """
    table = option_table(kind)
    display = kind.replace("_", " ")
    if name not in table:
        hint = did_you_mean(name, table) or f"Choose from {', '.join(table)}"
        raise OptionError(f"there is no option {name!r:.100} of a {display}. {hint}")
    if not table[name].accepts(value):
        raise OptionError(
            f"option '{name}' of a {display} must be {table[name].wanted()}, got {value!r:.100}"
        )


def _listed(kind: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    for each in _lists()[kind]:
        found += _listed(each) if isinstance(each, str) else [each]
    return found


@cache
def _lists() -> dict[str, list[Any]]:
    content: dict[str, list[Any]] = json.loads(_TABLE.read_text(encoding="utf-8"))
    return content


def _option(entry: Mapping[str, Any]) -> Option:
    return Option(
        entry["name"],
        entry["type"],
        entry["value"],
        entry.get("min", -_LARGEST),
        entry.get("max", _LARGEST),
        tuple(entry.get("choices", ())),
    )


def _is_item(value: object) -> bool:
    if not isinstance(value, dict) or not value.keys() <= {"shown", "alpha", "max"}:
        return False
    alpha, greatest = value.get("alpha", 1), value.get("max", 0)
    if not (is_finite_number(alpha) and is_finite_number(greatest)):
        return False
    return isinstance(value.get("shown", True), bool) and 0 <= alpha <= 1 and greatest >= 0


def _color_of(value: object) -> _Color | None:
    if isinstance(value, str) and _COLOR.fullmatch(value):
        return int(value[1:3], 16), int(value[3:5], 16), int(value[5:7], 16)
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        return None
    if not all(is_finite_number(part) and 0 <= part <= 255 for part in value):
        return None
    red, green, blue = (int(part) for part in value)
    return red, green, blue
