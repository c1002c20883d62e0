"""The output of a command."""

from __future__ import annotations

import os
import shlex
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution, described
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    import subprocess

    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("command")
class Command(Substitution):
    """The stdout of a command.

    Args:
        command: The command line.
        on_stderr: What output to stderr means: ``fail``, ``ignore``, ``warn`` or ``capture`` (it
            belongs to the text).
    """

    def __init__(
        self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail"
    ) -> None:
        self._command = normalize_to_list_of_substitutions(command)
        self._on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Command], dict[str, Any]]:
        """Read ``$(command 'line' [on_stderr])``."""
        if not 1 <= len(data) <= 2:
            raise ValueError("command substitution expects 1 or 2 arguments")
        return cls, {"command": data[0]} | ({"on_stderr": data[1]} if len(data) == 2 else {})

    @property
    def command(self) -> list[Substitution]:
        """The command line."""
        return self._command

    @property
    def on_stderr(self) -> list[Substitution]:
        """Meaning of output to stderr."""
        return self._on_stderr

    def describe(self) -> str:
        return f"Command({described(self._command)})"

    def perform(self, context: LaunchContext) -> str:
        """Run the command and return its output.

        Raises:
            SubstitutionFailure: The command cannot be run, fails, or writes to stderr where this
                counts as a failure.
        """
        line = perform_substitutions(context, self._command)
        on_stderr = perform_substitutions(context, self._on_stderr)
        if on_stderr not in ("fail", "ignore", "warn", "capture"):
            raise SubstitutionFailure("expected one of: 'fail', 'ignore', 'warn' or 'capture'")
        result = _run(line, capture=on_stderr == "capture")
        if result.returncode != 0:
            message = (
                f"executed command failed. Command: {line}\nCaptured stderr output: {result.stderr}"
            )
            raise SubstitutionFailure(message)
        if result.stderr:
            message = (
                f"executed command showed stderr output. Command: {line}\n"
                f"Captured stderr output:\n{result.stderr}"
            )
            if on_stderr == "fail":
                raise SubstitutionFailure(message)
            if on_stderr == "warn":
                logging.get_logger("launch.substitutions.command").warning("%s", message)
        return result.stdout


def _run(line: str, *, capture: bool) -> subprocess.CompletedProcess[str]:
    """Run a command line.

    Args:
        line: The command line.
        capture: Whether what it writes to stderr belongs to its output.

    Raises:
        SubstitutionFailure: The command cannot be run.
    """
    import subprocess

    stderr = subprocess.STDOUT if capture else subprocess.PIPE
    try:
        # On Windows, the split would break paths at their backslashes.
        command = line if os.name == "nt" else _found(shlex.split(line))
        if not command:
            raise SubstitutionFailure("the command is empty")
        return subprocess.run(  # noqa: S603
            command, stdout=subprocess.PIPE, stderr=stderr, text=True, check=False
        )
    except FileNotFoundError as error:
        raise SubstitutionFailure(f"file not found: {error}") from error
    except (OSError, ValueError) as error:  # such as a missing quote, or output in Latin-1
        raise SubstitutionFailure(f"command '{line}': {error}") from error


def _found(command: list[str]) -> list[str]:
    """Return the command, with the program's path if it is only next to this interpreter."""
    import shutil
    import sysconfig

    # pip installs programs such as xacro there, and without an activated environment the folder is
    # not in PATH.
    if command and shutil.which(command[0]) is None:
        beside = shutil.which(command[0], path=sysconfig.get_path("scripts"))
        return [beside or command[0], *command[1:]]
    return command
