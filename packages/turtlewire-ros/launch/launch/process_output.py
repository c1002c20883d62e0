"""The output of one process: kept, split into lines and logged."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

# A process that never ends its line must not fill the memory.
_LONGEST_REST = 1 << 20


class OutputLines:
    """Collects the bytes of one stream.

    Bytes that are not UTF-8 become replacement characters. A line of more than 1 MiB may come in
    pieces.
    """

    def __init__(self) -> None:
        self._rest = bytearray()

    def feed(self, data: bytes) -> list[str]:
        """Add bytes; returns the lines that they complete, without line ends."""
        first, *more = data.split(b"\n")
        self._rest += first
        if not more:
            return self.rest() if len(self._rest) > _LONGEST_REST else []
        lines = [bytes(self._rest), *more[:-1]]
        self._rest = bytearray(more[-1])
        return [_text(line) for line in lines]

    def rest(self) -> list[str]:
        """Return the beginning of an incomplete line; an empty list without one."""
        line, self._rest = bytes(self._rest), bytearray()
        return [_text(line)] if line else []


def _text(line: bytes) -> str:
    return line.decode("utf-8", errors="replace").removesuffix("\r")


class ProcessOutput:
    """The destinations of a process's lines, and what it has written.

    File descriptors are 1 for stdout and 2 for stderr.

    Args:
        output: Where lines go, as for ``ExecuteLocal``; the environment variable
            ``OVERRIDE_LAUNCH_PROCESS_OUTPUT`` replaces it.
        cached: Whether to keep all bytes.
    """

    def __init__(self, output: SomeSubstitutionsType | Mapping[str, Any], *, cached: bool) -> None:
        chosen: Any = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT") or output
        #: The choice, as a mapping or as substitutions of its name.
        self.destination: Any = (
            dict(chosen) if hasattr(chosen, "items") else normalize_to_list_of_substitutions(chosen)
        )
        #: Whether all bytes are kept.
        self.cached = cached
        self._cache = {1: bytearray(), 2: bytearray()}
        self._lines = {1: OutputLines(), 2: OutputLines()}

    def open(self, context: LaunchContext, name: str, form: Callable[[str], str]) -> None:
        """Prepare the log files.

        Args:
            context: Performs the substitutions of the destination.
            name: Unique name of the process.
            form: Makes the shown line from a line of output.
        """
        chosen = self.destination
        if not isinstance(chosen, dict):
            chosen = perform_substitutions(context, chosen)
        self._loggers = logging.get_output_loggers(
            name, chosen, logging.launch_config.main_log_file_name
        )
        self._form = form

    def keep(self, fd: int, data: bytes) -> None:
        """Keep bytes, if that is wanted."""
        if self.cached:
            self._cache[fd] += data

    def kept(self, fd: int) -> bytes:
        """Return the kept bytes."""
        return bytes(self._cache[fd])

    def show(self, fd: int, data: bytes) -> None:
        """Log the lines that the bytes complete."""
        self._log(fd, self._lines[fd].feed(data))

    def show_rest(self) -> None:
        """Log the last lines, even if they are not complete."""
        for fd, lines in self._lines.items():
            self._log(fd, lines.rest())

    def _log(self, fd: int, lines: list[str]) -> None:
        for line in lines:
            self._loggers[fd - 1].info("%s", self._form(line), extra={"from_process": True})
