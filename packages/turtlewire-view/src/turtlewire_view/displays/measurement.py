"""Measurements at a sensor: one number, or a linear and an angular part.

One number: Temperature, RelativeHumidity, FluidPressure, Illuminance. Two parts: TwistStamped,
AccelStamped, WrenchStamped.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import count
from typing import Any, NamedTuple

import numpy as np

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
from turtlewire_view.displays.points import by_value

__all__ = ["MeasurementDisplay", "TwistOrWrenchDisplay"]


class _Quantity(NamedTuple):
    """The text format of a quantity, and RViz's limits of its colours."""

    form: str
    factor: float
    bounds: tuple[float, float]


_QUANTITIES = {
    "temperature": _Quantity("{:.1f} °C", 1.0, (0.0, 100.0)),
    "relative_humidity": _Quantity("{:.0f} %", 100.0, (0.0, 1.0)),
    "fluid_pressure": _Quantity("{:.0f} Pa", 1.0, (98_000.0, 105_000.0)),
    "illuminance": _Quantity("{:.0f} lx", 1.0, (0.0, 1000.0)),
}


class MeasurementDisplay(Display):
    """The number of a message, as a ball with a colour, and as text.

    Options: the colour is one between ``min`` and ``max``, unless ``usual_bounds``, which takes
    RViz's bounds of the quantity; see :mod:`turtlewire_view.displays.points` for the others.
    """

    kind = "measurement"
    replays = True

    def _outputs(self, message: Any) -> list[Output]:
        field = next(name for name in _QUANTITIES if hasattr(message, name))
        form, factor, bounds = _QUANTITIES[field]
        value = float(getattr(message, field))
        if not math.isfinite(value):
            raise UnusableMessageError(f"the {field} is {value}")
        if not self.options.flag("usual_bounds"):
            bounds = (self.options.number("min"), self.options.number("max"))
        color = by_value(np.array([value]), self.options, bounds)[0].tolist()
        text = form.format(factor * value) if abs(value) < 1e9 else f"{value:g}"
        header = {"text": text, "color": color}
        return [Content(header, {}, frame_of(message), stamp_ns_of(message))]


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
