"""The faults that a lesson can switch on, by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlesim.testing import faults

if TYPE_CHECKING:
    from collections.abc import Callable

    from turtlesim.testing.faults import Fault

__all__ = ["FAULTS"]

FAULTS: dict[str, Callable[[], Fault]] = {
    "delay": lambda: faults.Delay(3.0, "turtle1"),
    "loss": lambda: faults.Loss(0.9),
    "wrong_frame": lambda: faults.WrongFrame("turtle1", "wolrd"),
    "wrong_time": lambda: faults.WrongTime(5.0, "turtle1"),
    "missing_static": lambda: faults.MissingStatic("tower"),
    "two_publishers": lambda: faults.TwoPublishers("turtle1", x=9.0, y=9.0),
}
"""What each name stands for."""
