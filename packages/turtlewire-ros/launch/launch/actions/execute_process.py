"""Runs a command."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch.actions.execute_local import ExecuteLocal
from launch.actions.shutdown_action import Shutdown
from launch.descriptions import Executable
from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action
from launch.substitutions import TextSubstitution

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

# Stands for a substitution while a command line is split; private-use characters occur in no
# command.
_PLACEHOLDER = 0xE000


@expose_action("executable")
class ExecuteProcess(ExecuteLocal):
    """Runs a command on this machine.

    Args:
        cmd: Program and arguments, each a text, a substitution or a list of these.
        prefix: What is put before the command, for example a debugger.
        name: Names the process; by default the program's file name.
        cwd: Working directory; by default that of the launch.
        env: The whole environment; by default that of the launch.
        additional_env: Variables in addition to them.
        **kwargs: See :class:`ExecuteLocal`.
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
        **kwargs: Any,
    ) -> None:
        description = Executable(
            cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=description, **kwargs)

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[type[ExecuteProcess], dict[str, Any]]:
        """Read an ``executable`` element.

        Args:
            entity: The element.
            parser: Reads its substitutions.
            ignore: Attributes that a subclass reads itself.
        """
        ignore = tuple(ignore or ())
        _, kwargs = super().parse(entity, parser)
        if "cmd" not in ignore:
            kwargs["cmd"] = split_command_line(parser.parse_substitution(entity.get_attr("cmd")))
        for attribute, keyword in (
            ("cwd", "cwd"),
            ("name", "name"),
            ("launch-prefix", "prefix"),
            ("output", "output"),
        ):
            value = None if attribute in ignore else entity.get_attr(attribute, optional=True)
            if value is not None:
                kwargs[keyword] = parser.parse_substitution(value)
        if (
            "output_format" not in ignore
            and (layout := entity.get_attr("output_format", optional=True)) is not None
        ):
            kwargs["output_format"] = layout
        kwargs |= _typed_attributes(entity, parser)
        if "env" not in ignore:
            variables = entity.get_attr("env", data_type=list[Entity], optional=True)
            if variables is not None:
                kwargs["additional_env"] = {
                    # Lists are not hashable.
                    tuple(
                        parser.parse_substitution(item.get_attr("name"))
                    ): parser.parse_substitution(item.get_attr("value"))
                    for item in variables
                }
                for item in variables:
                    item.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def name(self) -> str | list[Substitution] | None:
        """The unique name of the process; before its start what was given, or None."""
        final_name = self.process_description.final_name
        return self.process_description.name if final_name is None else final_name

    @property
    def cmd(self) -> list[list[Substitution]]:
        """Program and arguments."""
        return self.process_description.cmd

    @property
    def cwd(self) -> list[Substitution] | None:
        """Working directory."""
        return self.process_description.cwd

    @property
    def env(self) -> Any:
        """The whole environment, or None."""
        return self.process_description.env

    @property
    def additional_env(self) -> Any:
        """Variables in addition to the launch's, or None."""
        return self.process_description.additional_env


def split_command_line(line: Iterable[Substitution]) -> list[list[Substitution]]:
    """Split at blanks, as a shell does; substitutions stay whole."""
    substitutions = list(line)
    marked = "".join(
        part.text if isinstance(part, TextSubstitution) else chr(_PLACEHOLDER + number)
        for number, part in enumerate(substitutions)
    )
    return [_unmarked(word, substitutions) for word in shlex.split(marked)]


def _unmarked(word: str, substitutions: list[Substitution]) -> list[Substitution]:
    parts: list[Substitution] = []
    plain = ""
    for character in word:
        number = ord(character) - _PLACEHOLDER
        if 0 <= number < len(substitutions):
            parts += [TextSubstitution(text=plain)] * bool(plain)
            parts.append(substitutions[number])
            plain = ""
        else:
            plain += character
    # An empty word, such as `''`, stays an argument.
    return parts + [TextSubstitution(text=plain)] * bool(plain or not parts)


def _typed_attributes(entity: Entity, parser: Parser) -> dict[str, Any]:
    kwargs: dict[str, Any] = {}
    for attribute in ("sigkill_timeout", "sigterm_timeout"):
        value = entity.get_attr(attribute, data_type=float, optional=True, can_be_str=True)
        if value is not None:
            kwargs[attribute] = parser.parse_if_substitutions(value)
    for attribute, data_type in (
        ("respawn_delay", float),
        ("respawn_max_retries", int),
        ("shell", bool),
        ("emulate_tty", bool),
    ):
        value = entity.get_attr(attribute, data_type=data_type, optional=True, can_be_str=False)
        if value is not None:
            kwargs[attribute] = value
    respawn = entity.get_attr("respawn", data_type=bool, optional=True, can_be_str=True)
    if respawn is not None:
        kwargs["respawn"] = parser.parse_if_substitutions(respawn)
    on_exit = entity.get_attr("on_exit", optional=True)
    if on_exit is not None:
        if on_exit != "shutdown":
            raise ValueError(
                f'Attribute on_exit of Entity node expected to be "shutdown" but got `{on_exit}`'
            )
        kwargs["on_exit"] = [Shutdown()]
    return kwargs
