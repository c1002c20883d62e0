"""Base of all actions, and base of the actions that run processes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.conditions import IfCondition, UnlessCondition
from launch.events import ExecutionComplete
from launch.launch_description_entity import LaunchDescriptionEntity
from turtlewire.distro import LYRICAL, since

if TYPE_CHECKING:
    from launch.condition import Condition
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext


def _condition_in(entity: Entity, parser: Parser) -> dict[str, Any]:
    """Return the argument ``condition`` that an entity's attributes mean, if they mean one."""
    if_text = entity.get_attr("if", optional=True)
    unless_text = entity.get_attr("unless", optional=True)
    if if_text is not None and unless_text is not None:
        raise RuntimeError("if and unless conditions can't be used simultaneously")
    if if_text is not None:
        return {"condition": IfCondition(predicate_expression=parser.parse_substitution(if_text))}
    if unless_text is not None:
        return {
            "condition": UnlessCondition(
                predicate_expression=parser.parse_substitution(unless_text)
            )
        }
    return {}


class Action(LaunchDescriptionEntity):
    """Base of all actions. The condition is evaluated at each visit.

    Args:
        condition: The action takes effect only if it is true.
    """

    def __init__(self, *, condition: Condition | None = None) -> None:
        self._condition = condition

    if since(LYRICAL):

        @classmethod
        def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
            """Read the attributes that all actions in XML and YAML have: ``if`` and ``unless``."""
            return cls, _condition_in(entity, parser)

    else:

        @staticmethod
        def parse(  # type: ignore[misc]
            entity: Entity, parser: Parser
        ) -> tuple[type[Action], dict[str, Any]]:
            """Read the attributes that all actions in XML and YAML have: ``if`` and ``unless``."""
            return Action, _condition_in(entity, parser)

    @property
    def condition(self) -> Condition | None:
        """The condition, or None."""
        return self._condition

    @property
    def is_conditional(self) -> bool:
        """True if it has a condition."""
        return self._condition is not None

    def describe(self) -> str:
        """Return the text that ``ros2 launch --print`` shows."""
        return self.__repr__()

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Execute if the condition is true, and emit an event when the action has completed."""
        if self._condition is not None and not self._condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        # As in ROS 2, also if `execute` raises.
        finally:
            self._announce_completion(context)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Take effect; the returned entities are visited next. Subclasses define it.

        An action that does not has no effect.
        """
        del context
        return None

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Entities that belong to it: what its visit always returns."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the same, for inspection without running."""
        return self.get_sub_entities()

    def _announce_completion(self, context: LaunchContext) -> None:
        event = ExecutionComplete(action=self)
        if not context.would_handle_event(event):
            return
        future = self.get_asyncio_future()
        if future is None:
            context.emit_event_sync(event)
        else:
            future.add_done_callback(lambda _: context.emit_event_sync(event))


class ProcessAction(Action):
    """An action that runs a process; ROS 2's is ``ExecuteLocal``."""
