"""A managed node that runs in the process of a container."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch_ros._node.lifecycle import Autostart, LifecycleEventManager
from launch_ros.descriptions.composable_node import ComposableNode

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["ComposableLifecycleNode", "SomeSubstitutionsType_types_tuple"]


class ComposableLifecycleNode(ComposableNode):
    """A managed node that runs in the process of a container.

    Changes of its state become events, and ``ChangeState`` events change its state.

    Args:
        autostart: Whether to configure and activate the node when it was loaded: true or false, or
            text with one of these words.
        **kwargs: See :class:`ComposableNode`. The events need a name.
    """

    def __init__(self, *, autostart: bool | SomeSubstitutionsType = False, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._autostart = Autostart(autostart)

    @classmethod
    def parse_attributes(cls, parser: Parser, entity: Entity) -> dict[str, Any]:
        kwargs = super().parse_attributes(parser, entity)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True, can_be_str=True)
        if autostart is not None:
            kwargs["autostart"] = parser.parse_if_substitutions(autostart)
        return kwargs

    @property
    def node_autostart(self) -> bool | list[Substitution]:
        """The argument ``autostart``, with a text as substitutions."""
        return self._autostart.given

    def starts_itself(self, context: LaunchContext) -> bool:
        """Return True if the node is configured and activated when it was loaded."""
        return self._autostart.evaluate(context)

    def init_lifecycle_event_manager(self, context: LaunchContext) -> None:
        """Begin to watch the node, which may not be loaded yet; nothing happens without a name."""
        if self.node_name is not None:
            LifecycleEventManager(self).setup_lifecycle_manager(context)
