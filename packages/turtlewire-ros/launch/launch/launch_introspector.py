"""Shows a launch description as a tree, for ``ros2 launch --print``."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler
from launch.substitution import described
from launch.utilities import is_a

if TYPE_CHECKING:
    from launch.event_handler import BaseEventHandler
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.substitution import Substitution


class LaunchIntrospector:
    """Shows launch descriptions without running them."""

    def format_launch_description(self, launch_description: LaunchDescriptionEntity) -> str:
        """Return the tree of a description."""
        return "\n".join(
            [
                str(launch_description),
                *_indented(format_entities(launch_description.describe_sub_entities())),
            ]
        )


def format_substitutions(substitutions: Iterable[Substitution] | None) -> str:
    """Return the descriptions, joined."""
    return "None" if substitutions is None else described(substitutions)


def format_action(action: Action) -> list[str]:
    """Return an action, with its sub-entities below it."""
    if is_a(action, LogInfo):
        return [f"LogInfo({format_substitutions(action.msg)})"]
    if is_a(action, EmitEvent):
        return [f"EmitEvent(event='{action.event.name}')"]
    if is_a(action, ExecuteProcess):
        cmd = ", ".join(format_substitutions(part) for part in action.cmd)
        cwd, env = format_substitutions(action.cwd), _variables(action.env)
        return [
            f"ExecuteProcess(cmd=[{cmd}], cwd={cwd}, env={env}, shell={action.shell})",
            *_indented(_conditional(action)),
        ]
    if is_a(action, RegisterEventHandler):
        return [
            "RegisterEventHandler('" + str(action.event_handler) + "'):",
            *_indented(format_event_handler(action.event_handler)),
        ]
    return [
        f"Action('{action.describe()}')",
        *_indented(format_entities(action.describe_sub_entities())),
        *_indented(_conditional(action)),
    ]


def format_entities(entities: Iterable[LaunchDescriptionEntity]) -> list[str]:
    """Return the lines of entities, each with its sub-entities, indented, below it."""
    lines = []
    for entity in entities:
        if is_a(entity, Action):
            lines += format_action(entity)
        else:
            lines += [str(entity), *_indented(format_entities(entity.describe_sub_entities()))]
    return lines


def format_event_handler(event_handler: BaseEventHandler) -> list[str]:
    """Return a handler, with the entities that it returns."""
    text, entities = event_handler.describe()
    return [text, *_indented(format_entities(entities))]


def indent(lines: Iterable[str], indentation: str = "    ") -> list[str]:
    """Return the lines, each with an indentation."""
    return [f"{indentation}{line}" for line in lines]


def tree_like_indent(lines: list[str]) -> list[str]:
    """Return the lines of one level, with the branches that lead to them."""
    return _indented(lines)


def _conditional(action: Action) -> list[str]:
    lines = []
    for condition, entities in action.describe_conditional_sub_entities():
        lines += [condition, *_indented(format_entities(entities))]
    return lines


def _variables(env: Any) -> str:
    if env is None:
        return "None"
    return (
        "{"
        + ", ".join(
            f"{format_substitutions(name)}: {format_substitutions(value)}" for name, value in env
        )
        + "}"
    )


def _indented(lines: list[str]) -> list[str]:
    """Draw the branches to the lines of one level.

    Lines of deeper levels begin with a branch or a blank already.
    """
    starts = [index for index, line in enumerate(lines) if line[:1] not in ("├", "└", "│", " ")]
    result = []
    for index, line in enumerate(lines):
        last = bool(starts) and index >= starts[-1]
        if index in starts:
            result.append(("└── " if last else "├── ") + line)
        else:
            result.append(("    " if last else "│   ") + line)
    return result
