"""Arguments of a launch, as words of a command line."""

from __future__ import annotations

from collections.abc import Iterable

from launch.utilities.command_line import parse_arguments


def parse_launch_arguments(launch_arguments: Iterable[str]) -> list[tuple[str, str]]:
    """Split words ``name:=value``; of several with one name the last one counts.

    Raises:
        RuntimeError: A word has another form.
    """
    return parse_arguments(launch_arguments)
