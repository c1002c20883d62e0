"""Includes another launch file."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.actions.set_launch_configuration import SetLaunchConfiguration
from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources.any_launch_description_source import (
    AnyLaunchDescriptionSource,
)
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description import LaunchDescription
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType

_PATH_LOCALS = ("current_launch_file_path", "current_launch_file_directory")


@expose_action("include")
class IncludeLaunchDescription(Action):
    """Visits another launch description, with launch configurations set before.

    The configurations stay set afterwards; a ``GroupAction`` limits them to its own actions.

    Args:
        launch_description_source: The source, or the path of a file of any language.
        launch_arguments: Names and values of its arguments.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]
        | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(launch_description_source, LaunchDescriptionSource):
            launch_description_source = AnyLaunchDescriptionSource(launch_description_source)
        self._source = launch_description_source
        self._launch_arguments = list(launch_arguments or ())

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> tuple[type[IncludeLaunchDescription], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["launch_description_source"] = parser.parse_substitution(entity.get_attr("file"))
        arguments = entity.get_attr("arg", data_type=list[Entity], optional=True) or []
        # `let` replaced `arg` in ROS 2, which still reads both.
        arguments += entity.get_attr("let", data_type=list[Entity], optional=True) or []
        kwargs["launch_arguments"] = [
            (
                parser.parse_substitution(argument.get_attr("name")),
                parser.parse_substitution(argument.get_attr("value")),
            )
            for argument in arguments
        ]
        for argument in arguments:
            argument.assert_entity_completely_parsed()
        return cls, kwargs

    @property
    def is_inclusion(self) -> bool:
        """True: it includes a launch description."""
        return True

    @property
    def launch_description_source(self) -> LaunchDescriptionSource:
        """The source."""
        return self._source

    @property
    def launch_arguments(self) -> list[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]:
        """Names and values of its arguments."""
        return self._launch_arguments

    def describe(self) -> str:
        return f"IncludeLaunchDescription({self._source.location})"

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the included description, when it can be read without a running launch."""
        description = self._source.try_get_launch_description_without_context()
        return [] if description is None else [description]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Read the file; set the arguments, visit it, and forget its path.

        Raises:
            RuntimeError: An argument that it requires is missing.
        """
        description = self._source.get_launch_description(context)
        # The includer's path is back after the visit.
        before = {
            name: value
            for name, value in context.get_locals_as_dict().items()
            if name in _PATH_LOCALS
        }
        path = self._source.location
        context.extend_locals(
            {
                "current_launch_file_path": path,
                "current_launch_file_directory": os.path.dirname(os.path.abspath(path)),
            }
        )
        self._check_arguments(description, context)
        settings = [SetLaunchConfiguration(name, value) for name, value in self._launch_arguments]
        return [*settings, description, OpaqueFunction(function=_restore_paths, args=(before,))]

    def _check_arguments(self, description: LaunchDescription, context: LaunchContext) -> None:
        given = [
            perform_substitutions(context, normalize_to_list_of_substitutions(name))
            for name, _ in self._launch_arguments
        ]
        for (
            argument,
            inclusions,
        ) in description.get_launch_arguments_with_include_launch_description_actions():
            # Files that the included one includes are checked at their own inclusion.
            if argument.conditionally_included or argument.default_value is not None or inclusions:
                continue
            if argument.name not in context.launch_configurations and argument.name not in given:
                raise RuntimeError(
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(given)}]"
                )


def _restore_paths(context: LaunchContext, before: dict[str, Any]) -> None:
    context.extend_locals({name: before.get(name) for name in _PATH_LOCALS})
