"""A numeric field of a topic over some seconds, and its picture."""

from __future__ import annotations

import math
import re
import time
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING, Any

import numpy as np

from turtlewire.cli.assistant.permissions import RefusedCallError
from turtlewire.terminal.suggestion import did_you_mean
from turtlewire.trajectory.chart import COLOURS, Panel, page
from turtlewire.trajectory.pictures import png_of

if TYPE_CHECKING:
    from turtlewire.msg import Message

_STEP = re.compile(r"\.?([A-Za-z]\w*)|\[(\d+)\]")
_WIDTH, _HEIGHT = 640.0, 320.0


def number_at(message: Message, path: str) -> float:
    """Return the number in a field of a message.

    Args:
        message: A message.
        path: Such as ``pose.position.x`` or ``ranges[3]``.

    Raises:
        RefusedCallError: The field does not exist, or is not a number.
    """
    value: Any = message
    place = 0
    while place < len(path):
        step = _STEP.match(path, place)
        if step is None:
            raise RefusedCallError(
                f"{path!r} is not a field: write names with dots and numbers in brackets, "
                "such as pose.position.x or ranges[3]"
            )
        value = _item(value, int(step[2]), path) if step[2] else _field(value, step[1], path)
        place = step.end()
    if not isinstance(value, int | float | np.number):
        raise RefusedCallError(
            f"{path} is not a number, but {_kind_of(value)}. {_fields_of(value)}".rstrip()
        )
    return float(value)


def _field(value: Any, name: str, path: str) -> Any:
    names = _names_of(value)
    if name in names:
        return getattr(value, name)
    advice = ". ".join(filter(None, [did_you_mean(name, names), _fields_of(value)]))
    raise RefusedCallError(f"{path}: {_kind_of(value)} has no field {name}. {advice}".rstrip())


def _item(value: Any, index: int, path: str) -> Any:
    if isinstance(value, str | bytes) or not hasattr(value, "__len__"):
        raise RefusedCallError(f"{path}: [{index}] follows {_kind_of(value)}, which is not a list")
    if index >= len(value):
        raise RefusedCallError(f"{path}: there is no [{index}]; the list has {len(value)} items")
    return value[index]


def _names_of(value: Any) -> list[str]:
    definition = getattr(value, "_DEFINITION", None)
    return [] if definition is None else [field.name for field in definition.fields]


def _fields_of(value: Any) -> str:
    names = _names_of(value)
    return f"Its fields: {', '.join(names)}" if names else ""


def _kind_of(value: Any) -> str:
    return getattr(value, "_TYPE_NAME", None) or f"a value of the type {type(value).__name__}"


class Series:
    """The numbers of a field, with the times at which they arrived.

    Args:
        label: Of the picture: the topic and the field.
        path: As for `number_at`.
    """

    def __init__(self, label: str, path: str) -> None:
        self._label, self._path = label, path
        self._begin = time.monotonic()
        self._seconds: list[float] = []
        self._values: list[float] = []

    def __len__(self) -> int:
        return len(self._values)

    async def collect(self, messages: AsyncIterator[Message]) -> None:
        """Take the numbers of messages until there are no more, or the caller cancels it."""
        async for message in messages:
            self._values.append(number_at(message, self._path))
            self._seconds.append(time.monotonic() - self._begin)

    def summary(self) -> dict[str, Any]:
        """Return how many values there are, and the first, last, smallest, largest and mean."""
        finite = [value for value in self._values if math.isfinite(value)]
        summary: dict[str, Any] = {
            "values": len(self._values),
            "not_finite": len(self._values) - len(finite),
        }
        if finite:
            summary |= {"first": finite[0], "last": finite[-1], "min": min(finite)}
            summary |= {"max": max(finite), "mean": math.fsum(finite) / len(finite)}
        return summary

    def png(self, seconds: float) -> bytes:
        """Return the curve as a PNG file; numbers that are not finite are left out.

        Args:
            seconds: The length of the horizontal axis.

        Raises:
            ModuleNotFoundError: pypdfium2 is not installed.
        """
        x, y = np.array(self._seconds), np.array(self._values)
        shown = np.isfinite(y)
        x, y = x[shown], y[shown]
        y_range = (float(y.min()), float(y.max())) if len(y) else (0.0, 1.0)
        labels = "time [s]", self._path
        panel = Panel((0, 0, _WIDTH, _HEIGHT), (0.0, seconds), y_range, labels, title=self._label)
        panel.line(x, y, COLOURS[0])
        return png_of(page([panel], _WIDTH).svg)
