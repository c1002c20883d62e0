"""Ends the launch."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch import logging
from launch.actions.emit_event import EmitEvent
from launch.events import Shutdown as ShutdownEvent
from launch.events.process import ProcessExited
from launch.frontend.expose import expose_action

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext


@expose_action("shutdown")
class Shutdown(EmitEvent):
    """Ends the launch: all processes are stopped.

    Args:
        reason: Why.
        **kwargs: See :class:`Action`.
    """

    def __init__(self, *, reason: str = "reason not given", **kwargs: Any) -> None:
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Shutdown], dict[str, Any]]:
        _, kwargs = super().parse(entity, parser)
        reason = entity.get_attr("reason", optional=True)
        if reason is not None:
            kwargs["reason"] = parser.escape_characters(reason)
        return Shutdown, kwargs

    def execute(self, context: LaunchContext) -> None:
        """End the launch; if a process caused it by its end, log which."""
        event = context.get_locals_as_dict().get("event")
        if isinstance(event, ProcessExited):
            logging.get_logger("launch").info(
                "process[%s] was required: shutting down launched system", event.process_name
            )
        super().execute(context)
