"""TwistStamped, AccelStamped and WrenchStamped: a linear and an angular part."""

from __future__ import annotations

import math
from itertools import count
from typing import TYPE_CHECKING, Any

from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    Removal,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)
from turtlewire_view.displays.numeric import LARGEST

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["TwistOrWrenchDisplay"]


class TwistOrWrenchDisplay(Display):
    """The vectors of the last messages, at the origin of their frame.

    The header has ``linear`` and ``angular``: velocities [m/s, rad/s], accelerations [m/s², rad/s²]
    or force and torque [N, N m]. Options: ``history_length`` messages are kept; colours and sizes
    are the page's.
    """

    kind = "twist_or_wrench"

    def __init__(self, options: Mapping[str, object] | None = None, **keywords: Any) -> None:
        super().__init__(options, **keywords)
        self._numbers = count()
        self._parts: list[str] = []

    def _outputs(self, message: Any) -> list[Output]:
        header = {}
        for name, vector in zip(("linear", "angular"), _vectors(message), strict=True):
            header[name] = [float(vector.x), float(vector.y), float(vector.z)]
            if not all(math.isfinite(value) and abs(value) < LARGEST for value in header[name]):
                raise UnusableMessageError(f"the vector {header[name]} is not finite")
        frame_id, part = frame_of(message), str(next(self._numbers))
        self._parts.append(part)
        outputs: list[Output] = [Content(header, {}, frame_id, stamp_ns_of(message), part)]
        while len(self._parts) > self.options.number("history_length"):
            outputs.append(Removal(self._parts.pop(0)))
        return outputs


def _vectors(message: Any) -> tuple[Any, Any]:
    if hasattr(message, "wrench"):
        return message.wrench.force, message.wrench.torque
    moving = message.twist if hasattr(message, "twist") else message.accel
    return moving.linear, moving.angular
