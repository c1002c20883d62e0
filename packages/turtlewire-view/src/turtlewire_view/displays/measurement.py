"""Temperature, RelativeHumidity, FluidPressure and Illuminance: one number at a sensor."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from turtlewire_view.displays.coloring import by_value
from turtlewire_view.displays.content import (
    Content,
    Display,
    Output,
    UnusableMessageError,
    frame_of,
    stamp_ns_of,
)

__all__ = ["MeasurementDisplay"]


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
    RViz's bounds of the quantity; see :mod:`turtlewire_view.displays.coloring` for the others.
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
