"""A command with its working directory and environment."""

from __future__ import annotations

import itertools
import os
import re
import shlex
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.action import Action
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

# As in ROS 2, counted over all launches of this process.
_process_numbers = itertools.count(1)


class Executable:
    """A command with its working directory and environment.

    Args:
        cmd: Program and arguments.
        prefix: What is put before it, for example a debugger; by default the launch configuration
            ``launch-prefix``.
        name: Names the process; by default the program's file name.
        cwd: Working directory; by default that of the launch.
        env: The whole environment; by default that of the launch.
        additional_env: Variables in addition to them.
        arguments: Further arguments.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        self._arguments = (
            None if arguments is None else [*map(normalize_to_list_of_substitutions, arguments)]
        )
        self._cmd = [*map(normalize_to_list_of_substitutions, cmd), *(self._arguments or ())]
        default_prefix = LaunchConfiguration("launch-prefix", default="")
        self._prefix_is_default = prefix is None
        self._prefix = normalize_to_list_of_substitutions(
            default_prefix if prefix is None else prefix
        )
        self._prefix_filter = [LaunchConfiguration("launch-prefix-filter", default="")]
        self._name = None if name is None else normalize_to_list_of_substitutions(name)
        self._cwd = None if cwd is None else normalize_to_list_of_substitutions(cwd)
        self._env = None if env is None else _variables(env)
        self._additional_env = None if additional_env is None else _variables(additional_env)
        self._final_name: str | None = None
        self._final_cmd: list[str] | None = None
        self._final_cwd: str | None = None
        self._final_env: dict[str, str] | None = None
        self.prefix_length = 0

    @property
    def cmd(self) -> list[list[Substitution]]:
        """Program and arguments."""
        return self._cmd

    @property
    def prefix(self) -> list[Substitution]:
        """Prefix of the command."""
        return self._prefix

    @property
    def name(self) -> list[Substitution] | None:
        """Names the process."""
        return self._name

    @property
    def cwd(self) -> list[Substitution] | None:
        """Working directory."""
        return self._cwd

    @property
    def env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """The whole environment."""
        return self._env

    @property
    def additional_env(self) -> list[tuple[list[Substitution], list[Substitution]]] | None:
        """Variables in addition to the launch's."""
        return self._additional_env

    @property
    def arguments(self) -> list[list[Substitution]] | None:
        """Further arguments; they are also part of :attr:`cmd`."""
        return self._arguments

    @property
    def final_name(self) -> str | None:
        """The unique name, once :meth:`prepare` ran."""
        return self._final_name

    @property
    def final_cmd(self) -> list[str] | None:
        """The command line with prefix, once :meth:`prepare` ran."""
        return self._final_cmd

    @property
    def final_cwd(self) -> str | None:
        """The working directory, once :meth:`prepare` ran."""
        return self._final_cwd

    @property
    def final_env(self) -> dict[str, str] | None:
        """The environment, once :meth:`prepare` ran."""
        return self._final_env

    def prepare(self, context: LaunchContext, action: Action) -> None:
        """Perform all substitutions.

        Raises:
            SubstitutionFailure: A substitution has no value.
        """
        del action  # subclasses may want it
        cmd = [perform_substitutions(context, part) for part in self._cmd]
        base_name = os.path.basename(cmd[0])
        name = base_name if self._name is None else perform_substitutions(context, self._name)
        prefix = self._performed_prefix(context, base_name)
        self.prefix_length = len(prefix)
        self._final_cmd = [*prefix, *cmd]
        self._final_cwd = None if self._cwd is None else perform_substitutions(context, self._cwd)
        self._final_env = (
            dict(context.environment) if self._env is None else _performed(context, self._env)
        )
        self._final_env.update(_performed(context, self._additional_env or []))
        self._final_name = f"{name}-{next(_process_numbers)}"

    def _performed_prefix(self, context: LaunchContext, base_name: str) -> list[str]:
        pattern = perform_substitutions(context, self._prefix_filter)
        if self._prefix_is_default and pattern and not re.match(pattern, base_name):
            return []
        return shlex.split(perform_substitutions(context, self._prefix))


def _variables(
    env: Mapping[SomeSubstitutionsType, SomeSubstitutionsType],
) -> list[tuple[list[Substitution], list[Substitution]]]:
    # Also accepts pairs, as ROS 2 does, because lists of substitutions cannot be keys.
    pairs: Any = env.items() if hasattr(env, "items") else env
    return [
        (normalize_to_list_of_substitutions(name), normalize_to_list_of_substitutions(value))
        for name, value in pairs
    ]


def _performed(
    context: LaunchContext, variables: Iterable[tuple[list[Substitution], list[Substitution]]]
) -> dict[str, str]:
    return {
        perform_substitutions(context, name): perform_substitutions(context, value)
        for name, value in variables
    }
