"""Finds recorded processes by action, or by name and arguments."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Protocol

from launch.action import Action


class _NoArguments:
    """The type of `NO_CMD_ARGS`, which matches a command line without arguments."""

    def __repr__(self) -> str:
        return "NO_CMD_ARGS"


#: As ``cmd_args``: the process was started without arguments.
NO_CMD_ARGS = _NoArguments()


class NoMatchingProcessException(Exception):
    """No recorded process has that name and those arguments, or several have."""


class _Recorded(Protocol):
    def processes(self) -> Iterable[Any]:
        """Return the actions of the recorded processes."""


def resolveProcesses(  # noqa: N802  ROS 2's name
    info_obj: _Recorded,
    *,
    process: Any = None,
    cmd_args: Any = None,
    strict_proc_matching: bool = True,
) -> list[Any]:
    """Find the actions of processes.

    Args:
        info_obj: The records: ``proc_info`` or ``proc_output``.
        process: An action, a part of a process's name, or None for all processes.
        cmd_args: An argument that it must have been started with, ``NO_CMD_ARGS`` for none at
            all, or None for any. Used with a name only.
        strict_proc_matching: Whether several matches of a name are an error.

    Raises:
        NoMatchingProcessException: No process fits, or more than one.
        TypeError: ``process`` is neither an action nor text.
    """
    recorded = list(info_obj.processes())
    if process is None:
        if not recorded:
            raise NoMatchingProcessException("No processes recorded")
        return recorded
    if isinstance(process, Action):
        if process not in recorded:
            raise NoMatchingProcessException(
                f"No data recorded for proc {_command_line(process)}. Procs: {_list(recorded)}"
            )
        return [process]
    if not isinstance(process, str):
        raise TypeError(
            f"process must be None, an action or text, not {type(process).__name__} ({process!r})"
        )
    return _by_name(recorded, process, cmd_args, strict_proc_matching)


def _by_name(recorded: list[Any], name: str, cmd_args: Any, strict: bool) -> list[Any]:
    matches = [
        each
        for each in recorded
        if name in each.process_details["name"] and _has_arguments(each, cmd_args)
    ]
    if matches and (len(matches) == 1 or not strict):
        return matches
    what = "Found multiple" if matches else "Did not find any"
    raise NoMatchingProcessException(
        f"{what} processes matching name '{name}' and cmd_args '{cmd_args}'. "
        f"Procs: {_list(matches or recorded)}"
    )


def _has_arguments(process: Any, cmd_args: Any) -> bool:
    arguments = process.process_details["cmd"][1:]
    if cmd_args is NO_CMD_ARGS:
        return not arguments
    return cmd_args is None or cmd_args in arguments


def _command_line(process: Any) -> str:
    """Return the name and arguments; a process that never started has no details."""
    details = process.process_details
    if details is None:
        return str(process.describe())
    return " ".join([details["name"], *details["cmd"][1:]])


def _list(processes: list[Any]) -> str:
    return ", ".join(sorted(map(_command_line, processes))) or "none"
