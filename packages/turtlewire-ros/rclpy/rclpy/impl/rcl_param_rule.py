"""Parameter rules, ``[node:]name:=value``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .rcl_lexer import Lexeme, Lexer, RuleError
from .rcl_remap import parse_node_prefix
from .rcl_yaml_param_parser import parse_value

if TYPE_CHECKING:
    from .rcl_yaml_param_parser import ParameterValue


def parse_parameter_rule(text: str) -> tuple[str, str, ParameterValue]:
    """Read a rule.

    Returns:
        Pattern of node names (``/**`` when the rule names no node), name and value of the
        parameter.

    Raises:
        RuleError: The rule is malformed.
    """
    lexer = Lexer(text)
    node_name = parse_node_prefix(lexer) or "/**"
    start = lexer.index
    _name_token(lexer)
    while lexer.peek() != Lexeme.SEPARATOR:
        lexer.expect(Lexeme.DOT)
        _name_token(lexer)
    name = lexer.text[start : lexer.index]
    lexer.expect(Lexeme.SEPARATOR)
    return node_name, name, parse_value(lexer.rest)


def _name_token(lexer: Lexer) -> None:
    """Read the name between two dots.

    Slashes are part of it (``qos_overrides./chatter.publisher.depth``).
    """
    found = lexer.peek()
    if found in (Lexeme.WILD_ONE, Lexeme.WILD_MULTI):
        raise RuleError(f"Wildcard '{lexer.accept()}' is not implemented")
    if found not in (Lexeme.TOKEN, Lexeme.FORWARD_SLASH):
        raise RuleError("Expecting token or wildcard")
    while lexer.peek() in (Lexeme.TOKEN, Lexeme.FORWARD_SLASH):
        lexer.accept()
