"""Declares an argument of a launch file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch import logging
from launch.action import Action
from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action
from launch.substitution import TextSubstitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("arg")
class DeclareLaunchArgument(Action):
    """Declares an argument of a launch file.

    The command line gives its value as ``name:=value``, or the file that includes this one does.
    Its value is a launch configuration of that name.

    Args:
        name: Its name.
        default_value: Its value when it is not given; without one it must be given.
        description: What it is for.
        choices: The values it may have.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Iterable[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._name = name
        self._logger = logging.get_logger("launch.actions.declare_launch_argument")
        self._default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )
        self._choices = None if choices is None else list(choices)
        if self._choices is not None and not self._choices:
            raise ValueError(
                "Provided choices are empty. Please provide at least one choice or omit them."
            )
        _refuse_default_outside(self._default_value, self._choices)
        self._description = _described(description, self._choices)
        self.conditionally_included = False

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[DeclareLaunchArgument], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.escape_characters(entity.get_attr("name"))
        default = entity.get_attr("default", optional=True)
        if default is not None:
            kwargs["default_value"] = parser.parse_substitution(default)
        description = entity.get_attr("description", optional=True)
        if description is not None:
            kwargs["description"] = parser.escape_characters(description)
        choices = entity.get_attr("choice", data_type=list[Entity], optional=True)
        if choices is not None:
            kwargs["choices"] = [
                parser.escape_characters(choice.get_attr("value")) for choice in choices
            ]
            for choice in choices:
                choice.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def launch_argument(self) -> DeclareLaunchArgument:
        """Itself."""
        return self

    @property
    def name(self) -> str:
        """The name of the argument."""
        return self._name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The value of the argument if the user does not set it."""
        return self._default_value

    @property
    def description(self) -> str:
        """Purpose and valid values."""
        return self._description

    @property
    def choices(self) -> list[str] | None:
        """The values it may have, or None."""
        return self._choices

    def execute(self, context: LaunchContext) -> None:
        """Set the configuration to its default unless it is set, and check the choices.

        Raises:
            RuntimeError: The argument was not given, or its value is not allowed.
        """
        if self._name not in context.launch_configurations:
            if self._default_value is None:
                self._logger.error(
                    'Required launch argument "%s" (description: "%s") was not provided',
                    self._name,
                    self._description,
                )
                raise RuntimeError(f'Required launch argument "{self._name}" was not provided.')
            context.launch_configurations[self._name] = perform_substitutions(
                context, self._default_value
            )
        value = context.launch_configurations[self._name]
        if self._choices is not None and value not in self._choices:
            message = (
                f'Argument "{self._name}" provided value "{value}" is not valid. '
                f"Valid options are: {self._choices}"
            )
            self._logger.error("%s", message)
            raise RuntimeError(message)


def _refuse_default_outside(default: list[Substitution] | None, choices: list[str] | None) -> None:
    """Raise ValueError if a plain default is not among the choices."""
    if choices is None or default is None:
        return
    texts = [part.text for part in default if isinstance(part, TextSubstitution)]
    # A default with substitutions is checked when its value is known.
    if len(texts) == len(default) and "".join(texts) not in choices:
        raise ValueError(
            f'Provided default_value "{"".join(texts)}" is not in provided choices "{choices}".'
        )


def _described(description: str | None, choices: list[str] | None) -> str:
    if choices is None:
        return "no description given" if description is None else description
    valid = f"One of: {choices}"
    return valid if description is None else f"{description} Valid choices are: {choices}"
