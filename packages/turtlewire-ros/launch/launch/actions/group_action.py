"""Groups actions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions.pop_environment import PopEnvironment
from launch.actions.pop_launch_configurations import PopLaunchConfigurations
from launch.actions.push_environment import PushEnvironment
from launch.actions.push_launch_configurations import PushLaunchConfigurations
from launch.actions.reset_environment import ResetEnvironment
from launch.actions.reset_launch_configurations import (
    ResetLaunchConfigurations,
    kept_configurations,
)
from launch.actions.set_launch_configuration import SetLaunchConfiguration
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("group")
class GroupAction(Action):
    """Visits actions; what they set ends with the group.

    That is true of launch configurations and environment variables.

    Args:
        actions: The actions.
        scoped: Whether what they set ends with the group.
        forwarding: Whether configurations and variables from outside are known inside.
        launch_configurations: Configurations to set inside.
        **kwargs: See :class:`Action`.
    """

    def __init__(
        self,
        actions: Iterable[Action],
        *,
        scoped: bool = True,
        forwarding: bool = True,
        launch_configurations: Mapping[SomeSubstitutionsType, SomeSubstitutionsType] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self._actions = list(actions)
        self._scoped = scoped
        self._forwarding = forwarding
        self._launch_configurations = dict(launch_configurations or {})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[GroupAction], dict[str, Any]]:
        """Read a ``group`` element; ``keep`` children set launch configurations inside."""
        _, kwargs = super().parse(entity, parser)
        for attribute in ("scoped", "forwarding"):
            value = entity.get_attr(attribute, data_type=bool, optional=True, can_be_str=False)
            if value is not None:
                kwargs[attribute] = value
        if (kept := kept_configurations(entity, parser)) is not None:
            kwargs["launch_configurations"] = kept
        kwargs["actions"] = [
            parser.parse_action(child) for child in entity.children if child.type_name != "keep"
        ]
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return the actions, between the actions that begin and end the scope."""
        del context
        return self.get_sub_entities()

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        settings = [
            SetLaunchConfiguration(name, value)
            for name, value in self._launch_configurations.items()
        ]
        if not self._scoped:
            return [*settings, *self._actions]
        inside: list[LaunchDescriptionEntity] = [PushLaunchConfigurations(), PushEnvironment()]
        if self._forwarding:
            inside += settings
        else:
            inside += [ResetEnvironment(), ResetLaunchConfigurations(self._launch_configurations)]
        return [*inside, *self._actions, PopEnvironment(), PopLaunchConfigurations()]
