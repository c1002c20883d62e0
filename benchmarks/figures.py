"""A measured figure, and one row of the table."""

from __future__ import annotations

from dataclasses import dataclass, field

FACTORS = {"ns": 1.0, "µs": 1e3, "ms": 1e6, "s": 1e9}


@dataclass(frozen=True)
class Figure:
    """The result of repeated measurements.

    The minimum is the undisturbed cost; the median is the typical one.
    """

    minimum: float
    median: float
    unit: str = "ns"

    def text(self) -> str:
        if self.unit != "ns":
            return f"{self.minimum:.4g} / {self.median:.4g} {self.unit}"
        unit = next(
            unit
            for unit, factor in reversed(FACTORS.items())
            if self.minimum >= factor or unit == "ns"
        )
        return f"{self.minimum / FACTORS[unit]:.4g} / {self.median / FACTORS[unit]:.4g} {unit}"


@dataclass(frozen=True)
class Row:
    """A row of the table: a measurement, our figure, the rivals', the budget, the floor."""

    what: str
    ours: Figure
    rivals: dict[str, Figure] = field(default_factory=dict)
    budget: str = ""
    floor: Figure | None = None
