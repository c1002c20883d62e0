"""Names of actions and substitutions in launch files in XML and YAML."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from launch.frontend.entity import Entity
    from launch.substitution import Substitution

_Exposed = TypeVar("_Exposed")

#: Name of an action to the function that reads it: ``(entity, parser) -> (class, keyword
#: arguments)``.
action_parse_methods: dict[str, Callable[..., Any]] = {}
#: Name of a substitution to the function that reads it: ``(arguments) -> (class, keyword
#: arguments)``.
substitution_parse_methods: dict[str, Callable[..., Any]] = {}


def expose_action(name: str) -> Callable[[_Exposed], _Exposed]:
    """Name an action in XML and YAML: a class with a class method ``parse``, or such a function."""
    return _expose(name, action_parse_methods, "action")


def expose_substitution(name: str) -> Callable[[_Exposed], _Exposed]:
    """Name a substitution in XML and YAML, as :func:`expose_action` does an action."""
    return _expose(name, substitution_parse_methods, "substitution")


def instantiate_action(entity: Entity, parser: Any) -> Any:
    """Make the action of an element.

    Raises:
        RuntimeError: No action has this name.
        ValueError: The element has attributes or children that the action does not know.
    """
    if entity.type_name not in action_parse_methods:
        raise RuntimeError(f"Unrecognized entity of the type: {entity.type_name}")
    action_class, keywords = action_parse_methods[entity.type_name](entity, parser)
    entity.assert_entity_completely_parsed()
    return action_class(**keywords)


def instantiate_substitution(
    type_name: str, args: list[list[Substitution]] | None = None
) -> Substitution:
    """Make a substitution.

    Args:
        type_name: Its name in XML and YAML.
        args: Its arguments.

    Raises:
        RuntimeError: No substitution has this name.
    """
    if type_name not in substitution_parse_methods:
        raise RuntimeError(f"Unknown substitution: {type_name}")
    substitution_class, keywords = substitution_parse_methods[type_name](args or [])
    positional = keywords.pop("args", ())
    made: Substitution = substitution_class(*positional, **keywords)
    return made


def _expose(
    name: str, methods: dict[str, Callable[..., Any]], kind: str
) -> Callable[[_Exposed], _Exposed]:
    def decorate(exposed: _Exposed) -> _Exposed:
        method = getattr(exposed, "parse", exposed)
        if not callable(method):
            raise RuntimeError(  # noqa: TRY004  as in ROS 2
                f"While exposing {kind} '{name}', "
                "it must be a callable or have a callable `parse` method"
            )
        if name in methods and methods[name] != method:
            raise RuntimeError(f"Two {kind}s are exposed as '{name}'")
        methods[name] = method
        return exposed

    return decorate
