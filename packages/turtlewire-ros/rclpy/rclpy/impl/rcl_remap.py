"""Remap rules, ``[node:]from:=to``: their grammar and what they do to names."""

from __future__ import annotations

from enum import Flag
from typing import NamedTuple

from turtlewire.wire import names

from .rcl_lexer import Lexeme, Lexer, RuleError


class RemapKind(Flag):
    """The kinds of names that rules rename."""

    TOPIC = 1
    SERVICE = 2
    NODE_NAME = 4
    NAMESPACE = 8


class RemapRule(NamedTuple):
    """One rule.

    Attributes:
        kind: What it renames; a plain name means topics and services.
        node_name: The only node that it is for, None for all.
        match: The name as written, to be expanded by the node; empty for the node's own name and
            namespace.
        replacement: The new name as written.
    """

    kind: RemapKind
    node_name: str | None
    match: str
    replacement: str

    def applies_to(self, kind: RemapKind, name: str, node_name: str, namespace: str) -> bool:
        """Return True if it renames ``name`` (fully qualified) of this node."""
        if not self.kind & kind or (self.node_name is not None and self.node_name != node_name):
            return False
        return not self.match or names.expand_topic_name(self.match, node_name, namespace) == name


def remap(
    rules: list[RemapRule], kind: RemapKind, name: str, node_name: str, namespace: str
) -> str:
    """Return the new name by the first rule that applies, or ``name`` itself.

    Args:
        rules: The rules, in order of precedence.
        kind: What ``name`` is, a single flag.
        name: Fully qualified for topics and services.
        node_name: Name of the node after its own renaming, except when that is what is asked for.
        namespace: Namespace of the node.
    """
    for rule in rules:
        if rule.applies_to(kind, name, node_name, namespace):
            if kind & (RemapKind.TOPIC | RemapKind.SERVICE):
                return names.expand_topic_name(rule.replacement, node_name, namespace)
            return rule.replacement
    return name


def parse_remap_rule(text: str) -> RemapRule:
    """Read a rule.

    Raises:
        RuleError: The rule is malformed.
    """
    lexer = Lexer(text)
    node_name = parse_node_prefix(lexer)
    first = lexer.peek()
    if first == Lexeme.NODE:
        rule = RemapRule(RemapKind.NODE_NAME, node_name, "", _new_node_name(lexer))
    elif first == Lexeme.NS:
        rule = RemapRule(RemapKind.NAMESPACE, node_name, "", _new_namespace(lexer))
    else:
        kind, match = _match_side(lexer)
        lexer.expect(Lexeme.SEPARATOR)
        rule = RemapRule(kind, node_name, match, _replacement(lexer))
    lexer.expect(Lexeme.EOF)
    return rule


def parse_node_prefix(lexer: Lexer) -> str | None:
    """Read ``node:`` if the rule starts with it."""
    if lexer.peek2() != (Lexeme.TOKEN, Lexeme.COLON):
        return None
    node_name = lexer.accept()
    lexer.expect(Lexeme.COLON)
    return node_name


def _new_node_name(lexer: Lexer) -> str:
    lexer.expect(Lexeme.NODE)
    lexer.expect(Lexeme.SEPARATOR)
    if lexer.peek() != Lexeme.TOKEN:
        # ROS 2 logs this, and then raises the error of `expect`.
        _warn(f"Node name not remapped to invalid name: '{lexer.rest}'")
    return lexer.expect(Lexeme.TOKEN)


def _new_namespace(lexer: Lexer) -> str:
    lexer.expect(Lexeme.NS)
    lexer.expect(Lexeme.SEPARATOR)
    start = lexer.index
    if lexer.peek() == Lexeme.FORWARD_SLASH:
        lexer.accept()
        while lexer.peek() == Lexeme.TOKEN:
            lexer.accept()
            if lexer.peek() == Lexeme.FORWARD_SLASH:
                lexer.accept()
        if lexer.peek() == Lexeme.EOF:
            return lexer.text[start:]
    _warn(f"Namespace not remapped to a fully qualified name (found: {lexer.text[start:]})")
    lexer.expect(Lexeme.FORWARD_SLASH if lexer.index == start else Lexeme.EOF)
    raise AssertionError("expect() has raised")


def _match_side(lexer: Lexer) -> tuple[RemapKind, str]:
    kind = {Lexeme.URL_SERVICE: RemapKind.SERVICE, Lexeme.URL_TOPIC: RemapKind.TOPIC}.get(
        lexer.peek()
    )
    if kind is not None:
        lexer.accept()
    start = lexer.index
    _accept_root(lexer)
    _match_token(lexer)
    while lexer.peek() != Lexeme.SEPARATOR:
        lexer.expect(Lexeme.FORWARD_SLASH)
        _match_token(lexer)
    return kind or RemapKind.TOPIC | RemapKind.SERVICE, lexer.text[start : lexer.index]


def _replacement(lexer: Lexer) -> str:
    start = lexer.index
    _accept_root(lexer)
    _replacement_token(lexer)
    while lexer.peek() != Lexeme.EOF:
        lexer.expect(Lexeme.FORWARD_SLASH)
        _replacement_token(lexer)
    return lexer.text[start:]


def _accept_root(lexer: Lexer) -> None:
    if lexer.peek() in (Lexeme.TILDE_SLASH, Lexeme.FORWARD_SLASH):
        lexer.accept()


def _match_token(lexer: Lexer) -> None:
    found = lexer.peek()
    if found in (Lexeme.WILD_ONE, Lexeme.WILD_MULTI):
        raise RuleError(f"Wildcard '{lexer.accept()}' is not implemented")
    if found != Lexeme.TOKEN:
        raise RuleError("Expecting token or wildcard")
    lexer.accept()


def _replacement_token(lexer: Lexer) -> None:
    if lexer.peek() == Lexeme.BACKREFERENCE:
        raise RuleError("Backreferences are not implemented")
    lexer.expect(Lexeme.TOKEN)


def _warn(text: str) -> None:
    from rclpy.logging import get_logger

    get_logger("rcl").warning(text)
