"""Makes all nodes that follow use the time from ``/clock``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend import expose_action
from launch_ros.actions.set_parameter import SetParameter

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_action("set_use_sim_time")
class SetUseSimTime(SetParameter):
    """Sets ``use_sim_time`` of all nodes that follow.

    Args:
        value: True or false, or text with one of these words.
        **kwargs: See :class:`launch.Action`.
    """

    def __init__(self, value: bool | SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(name="use_sim_time", value=value, **kwargs)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[SetUseSimTime], dict[str, Any]]:
        """Read a ``set_use_sim_time`` element."""
        _, kwargs = super(SetParameter, cls).parse(entity, parser)
        kwargs["value"] = parser.parse_if_substitutions(
            entity.get_attr("value", data_type=bool, can_be_str=True)
        )
        return cls, kwargs
