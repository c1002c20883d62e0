"""Commands that run programs: ``execute_process``, ``add_custom_command`` and the like."""

from __future__ import annotations

import shlex
import subprocess
from typing import TYPE_CHECKING

from turtlewire_colcon.cmake.plan import Step
from turtlewire_colcon.cmake.syntax import CMakeError, parse_keywords
from turtlewire_colcon.cmake.tool import tool_command

if TYPE_CHECKING:
    from turtlewire_colcon.cmake.interpreter import ExpandedCommand, Handler, Interpreter

__all__ = ["PROCESSES"]

_OPTIONS = (
    "ALL", "VERBATIM", "APPEND", "USES_TERMINAL", "COMMAND_EXPAND_LISTS",
    "OUTPUT_QUIET", "ERROR_QUIET", "OUTPUT_STRIP_TRAILING_WHITESPACE",
    "ERROR_STRIP_TRAILING_WHITESPACE", "PRE_BUILD", "PRE_LINK", "POST_BUILD",
)  # fmt: skip
_VALUES = (
    "WORKING_DIRECTORY", "RESULT_VARIABLE", "RESULTS_VARIABLE", "OUTPUT_VARIABLE",
    "ERROR_VARIABLE", "COMMAND_ERROR_IS_FATAL", "TIMEOUT", "COMMENT", "MAIN_DEPENDENCY",
    "TARGET", "ENCODING", "COMMAND_ECHO", "DEPFILE",
)  # fmt: skip
_OPERATORS = frozenset({">", ">>", "<", "|", "&&", "||", "2>", "2>&1"})
_LISTS = ("OUTPUT", "DEPENDS", "BYPRODUCTS", "SOURCES", "ARGS")


def _execute_process(run: Interpreter, call: ExpandedCommand) -> None:
    commands, words = _commands(call.words)
    parsed = parse_keywords(words, _OPTIONS, _VALUES, _LISTS)
    if len(commands) != 1:
        raise CMakeError(call.place, "execute_process() supports a single COMMAND here")
    folder = run.binary_path(parsed.values.get("WORKING_DIRECTORY", "."))
    try:
        # The command is the package's own, as with CMake.
        done = subprocess.run(  # noqa: S603
            tool_command(commands[0]),
            cwd=folder,
            env=dict(run.environment),
            capture_output=True,
            text=True,
            check=False,
        )
        result, output, errors = str(done.returncode), done.stdout, done.stderr
    except OSError as error:
        result, output, errors = str(error), "", str(error)
    if "OUTPUT_STRIP_TRAILING_WHITESPACE" in parsed.options:
        output = output.rstrip()
    for keyword, value in (
        ("RESULT_VARIABLE", result), ("OUTPUT_VARIABLE", output), ("ERROR_VARIABLE", errors)
    ):  # fmt: skip
        if keyword in parsed.values:
            run.variables[parsed.values[keyword]] = value
    if result != "0" and "COMMAND_ERROR_IS_FATAL" in parsed.values:
        raise CMakeError(call.place, f"{' '.join(commands[0])}: {errors.strip() or result}")


def _custom_command(run: Interpreter, call: ExpandedCommand) -> None:
    commands, words = _commands(call.words)
    parsed = parse_keywords(words, _OPTIONS, _VALUES, _LISTS)
    if "TARGET" in parsed.values and parsed.values["TARGET"] not in run.plan.custom_targets:
        return  # it belongs to a compiled target
    _add_steps(run, call, commands, parsed.values.get("WORKING_DIRECTORY", "."))


def _custom_target(run: Interpreter, call: ExpandedCommand) -> None:
    name, *rest = call.words
    commands, words = _commands(rest)
    # A target may begin with its command, without the keyword.
    parsed = parse_keywords(words, _OPTIONS, _VALUES, _LISTS)
    run.plan.targets.add(name)
    run.plan.custom_targets.add(name)
    if "ALL" in parsed.options:
        _add_steps(run, call, commands, parsed.values.get("WORKING_DIRECTORY", "."))


def _add_steps(
    run: Interpreter, call: ExpandedCommand, commands: list[list[str]], folder: str
) -> None:
    for command in commands:
        run.plan.steps.append(
            Step(_shell(tool_command(command)), run.binary_path(folder), call.place)
        )


def _shell(words: list[str]) -> tuple[str, ...]:
    """Return a command; one that redirects its output needs a shell, as under make."""
    if not _OPERATORS & {*words}:
        return tuple(words)
    text = " ".join(word if word in _OPERATORS else shlex.quote(word) for word in words)
    return ("sh", "-c", text)


def _commands(words: list[str]) -> tuple[list[list[str]], list[str]]:
    """Return the commands among the words, and the other words."""
    commands: list[list[str]] = []
    rest: list[str] = []
    keywords = {*_OPTIONS, *_VALUES, *_LISTS} - {"ARGS"}
    inside = False
    for word in words:
        if word == "COMMAND":
            commands.append([])
            inside = True
        elif word in keywords:
            rest.append(word)
            inside = False
        elif inside:
            if word != "ARGS":
                commands[-1].append(word)
        else:
            rest.append(word)
    return [command for command in commands if command], rest


PROCESSES: dict[str, Handler] = {
    "execute_process": _execute_process,
    "add_custom_command": _custom_command,
    "add_custom_target": _custom_target,
}
