"""Runs a managed node."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.event_handlers import OnProcessExit
from launch.frontend import expose_action
from launch_ros._node.lifecycle import (
    TO_ACTIVE,
    Autostart,
    LifecycleEventManager,
    change_states,
)
from launch_ros.actions.node import Node

if TYPE_CHECKING:
    import asyncio

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution


@expose_action("lifecycle_node")
class LifecycleNode(Node):
    """Runs a managed node.

    Changes of its state become events, and :class:`ChangeState` events change its state.

    Args:
        name: Name of the node.
        namespace: Namespace of the node.
        autostart: Whether to configure and activate the node when it has started: true or false, or
            text with one of these words.
        **kwargs: See :class:`Node`.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType,
        namespace: SomeSubstitutionsType,
        autostart: bool | SomeSubstitutionsType = False,
        **kwargs: Any,
    ) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self._autostart = Autostart(autostart)
        self._manager: LifecycleEventManager | None = None
        self._activation: asyncio.Task[None] | None = None

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: Iterable[str] | None = None
    ) -> tuple[type[LifecycleNode], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser, ignore)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True, can_be_str=True)
        if autostart is not None:
            kwargs["autostart"] = parser.parse_if_substitutions(autostart)
        return cls, kwargs

    @property
    def node_autostart(self) -> bool | list[Substitution]:
        """The argument ``autostart``, with a text as substitutions."""
        return self._autostart.given

    @property
    def is_lifecycle_node(self) -> bool:
        """True."""
        return True

    def get_lifecycle_event_manager(self) -> LifecycleEventManager | None:
        """Return what watches the node; None before the node is run."""
        return self._manager

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Run the process, and watch the node's state."""
        if context.is_shutdown:
            return None
        entities = super().execute(context)
        self._manager = LifecycleEventManager(self)
        self._manager.setup_lifecycle_manager(context)
        if self._autostart.evaluate(context):
            assert context.asyncio_loop is not None
            change = change_states(context, self.node_name, TO_ACTIVE)
            self._activation = context.asyncio_loop.create_task(change)
            context.add_completion_future(self._activation)
            context.register_event_handler(
                OnProcessExit(target_action=self, on_exit=self._abandon_activation)
            )
        return entities

    def _abandon_activation(self, *_: Any) -> None:
        """Stop waiting; the process has ended and will not answer."""
        assert self._activation is not None
        self._activation.cancel()
