"""A request to send a signal to a process."""

from __future__ import annotations

import signal as signal_module
from collections.abc import Callable
from typing import TYPE_CHECKING

from launch.events.process.process_targeted_event import ProcessTargetedEvent

if TYPE_CHECKING:
    from launch._kernel.protocols import ProcessRunner


class SignalProcess(ProcessTargetedEvent):
    """A request to send a signal to a process.

    Args:
        signal_number: The signal, by number or name (``SIGINT``).
        process_matcher: Which processes: a predicate over their actions.
    """

    name = "launch.events.process.SignalProcess"

    def __init__(
        self, *, signal_number: str | int, process_matcher: Callable[[ProcessRunner], bool]
    ) -> None:
        super().__init__(process_matcher=process_matcher)
        named = (
            signal_module.Signals[signal_number]
            if isinstance(signal_number, str)
            else signal_module.Signals(signal_number)
        )
        self._signal = named

    @property
    def signal(self) -> signal_module.Signals:
        """The signal."""
        return self._signal

    @property
    def signal_name(self) -> str:
        """The name of the signal, for example ``SIGINT``."""
        return self._signal.name
