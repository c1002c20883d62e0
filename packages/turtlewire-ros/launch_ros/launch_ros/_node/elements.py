"""Reads ``param`` and ``remap`` elements of XML and YAML launch files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from launch.frontend import Entity
from launch.frontend.type_utils import get_data_type_from_identifier
from launch.substitutions import TextSubstitution
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.frontend import Parser
    from launch.substitution import Substitution


def parse_remappings(
    entity: Entity, parser: Parser
) -> list[tuple[list[Substitution], list[Substitution]]]:
    """Return the pairs of the ``remap`` elements in an element."""
    pairs = []
    for rule in entity.get_attr("remap", data_type=list[Entity], optional=True) or ():
        pairs.append(
            (
                parser.parse_substitution(rule.get_attr("from")),
                parser.parse_substitution(rule.get_attr("to")),
            )
        )
        rule.assert_entity_completely_parsed()
    return pairs


def parse_parameters(entity: Entity, parser: Parser) -> list[Any]:
    """Return the ``param`` elements in an element.

    A file has ``from``, a value ``name`` and ``value``; elements may be nested.

    Raises:
        RuntimeError: An element has neither or too much.
    """
    elements = entity.get_attr("param", data_type=list[Entity], optional=True)
    return parse_parameter_elements(elements or (), parser)


def parse_parameter_elements(elements: Iterable[Entity], parser: Parser) -> list[Any]:
    """Return the same of ``param`` elements that were found already."""
    parsed: list[Any] = []
    for parameter in elements:
        path = parameter.get_attr("from", optional=True)
        if path is None:
            parsed.append(_parse_nested(parameter, parser))
        else:
            if parameter.get_attr("name", optional=True) is not None:
                raise RuntimeError("name and from attributes are mutually exclusive")
            allow = parameter.get_attr("allow_substs", data_type=bool, optional=True)
            parsed.append(
                ParameterFile(
                    parser.parse_substitution(path),
                    allow_substs=parser.parse_if_substitutions(allow or False),
                )
            )
        parameter.assert_entity_completely_parsed()
    return parsed


def parse_value(
    entity: Entity, parser: Parser, data_type: Any = None, *, optional: bool = False
) -> Any:
    """Return the attribute ``value``: a number, a truth value, a text or substitutions."""
    return _parsed(entity.get_attr("value", data_type=data_type, optional=optional), parser)


def _parsed(value: Any, parser: Parser) -> Any:
    if isinstance(value, list):
        return [_parsed(item, parser) for item in value]
    if not isinstance(value, str):
        return value
    parts = parser.parse_substitution(value)
    # The result of a substitution is parsed as YAML; plain text in the file stays text.
    return parts[0].text if len(parts) == 1 and isinstance(parts[0], TextSubstitution) else parts


def _parse_nested(parameter: Entity, parser: Parser) -> dict[Any, Any]:
    name = tuple(parser.parse_substitution(parameter.get_attr("name")))
    nested = parameter.get_attr("param", data_type=list[Entity], optional=True)
    kind = parameter.get_attr("type", optional=True)
    value_type = None if kind is None else get_data_type_from_identifier(kind)
    value = parse_value(parameter, parser, value_type, optional=True)
    if nested is not None and value is not None:
        raise RuntimeError("nested parameters and value attributes are mutually exclusive")
    if nested is None and value is None:
        raise RuntimeError("either a value attribute or nested parameters are needed")
    if nested is None:
        return {name: ParameterValue(value, value_type=value_type)}
    inner: dict[Any, Any] = {}
    for child in nested:
        inner |= _parse_nested(child, parser)
        child.assert_entity_completely_parsed()
    return {name: inner}
