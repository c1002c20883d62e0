"""Waits until a process says that it is ready."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.event_handlers import OnProcessIO

if TYPE_CHECKING:
    from launch import SomeActionsType
    from launch.events.process import ProcessIO


class StdoutReadyListener(OnProcessIO):
    """Visits actions when a process writes a text to stdout.

    Args:
        target_action: The action that runs the process; None for any process.
        ready_txt: The text.
        actions: The actions.
    """

    def __init__(
        self, *, target_action: Any = None, ready_txt: str, actions: SomeActionsType
    ) -> None:
        self._ready_text = ready_txt
        self._actions = actions
        self._rest: dict[str, str] = {}
        super().__init__(target_action=target_action, on_stdout=self._on_stdout)

    def _on_stdout(self, event: ProcessIO) -> SomeActionsType | None:
        # A text may come in two pieces: what may be its beginning is kept.
        text = self._rest.get(event.process_name, "") + event.text.decode(errors="replace")
        if self._ready_text not in text:
            self._rest[event.process_name] = text[-len(self._ready_text) :]
            return None
        self._rest[event.process_name] = ""
        return self._actions
