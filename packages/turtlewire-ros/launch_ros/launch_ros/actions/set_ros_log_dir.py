"""Sets the folder of the log files of all nodes that follow."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend import expose_action
from launch.logging import launch_config
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("set_ros_log_dir")
class SetROSLogDir(Action):
    """Sets the folder of the log files of all nodes that follow.

    Args:
        new_log_dir: The folder; a relative one lies below that which is set, or else below the
            folder of this launch.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(self, new_log_dir: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._new_log_dir = normalize_to_list_of_substitutions(new_log_dir)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetROSLogDir], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        kwargs["new_log_dir"] = parser.parse_substitution(entity.get_attr("new_log_dir"))
        return cls, kwargs

    @property
    def log_dir(self) -> list[Substitution]:
        """The folder."""
        return self._new_log_dir

    def execute(self, context: LaunchContext) -> None:
        path = perform_substitutions(context, self._new_log_dir)
        # `os.path.join` drops the folder before if the path is absolute.
        before = context.environment.get("ROS_LOG_DIR") or launch_config.log_dir
        context.environment["ROS_LOG_DIR"] = os.path.join(before, path)
