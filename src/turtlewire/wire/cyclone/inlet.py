"""Messages that Cyclone's own thread hands to a compiled intake, without Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import library as dds
from .taking import NATIVE_FUNCTIONS

if TYPE_CHECKING:
    from turtlewire._native import Intake

__all__ = ["Inlet"]


class Inlet:
    """Connects one reader with an intake: native code is the reader's listener, and triggers the guard condition for the rest.

    Attributes:
        intake: It is kept alive until the inlet is closed.
        guard: The condition that is true while the intake has kept back messages, or listeners of
            its buffers are to be called.
        listener: What to create the reader with.
    """

    def __init__(self, participant: int, intake: Intake) -> None:
        self.intake = intake
        self.guard = dds.check(dds.create_guard_condition(participant), "create a guard condition")
        callback, argument = intake.connect(NATIVE_FUNCTIONS, self.guard)
        self.listener = dds.create_listener(argument)
        dds.lset_data_available(self.listener, callback)

    def rest(self) -> list[tuple[bytes, int, int]]:
        """Reset the guard condition, take what was kept back, and call listeners.

        To be repeated until it returns nothing.
        """
        dds.set_guard_condition(self.guard, False)
        kept = self.intake.take()  # first: it may store messages, which the listeners are told of
        self.intake.call_listeners()
        return kept

    def close(self) -> None:
        """To be called when the reader has been deleted: then no thread is in the native code any more."""
        dds.delete_listener(self.listener)
        dds.delete(self.guard)
