"""Syntax trees of IDL, made by lark with the grammar of this package, and their values.

:mod:`rosidl_parser.parser` re-exports the functions. `parse_idl_string` needs no tree.
"""

from __future__ import annotations

import functools
import os
import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from rosidl_parser.definition import Annotation
from turtlewire.msg.idl_reader import number_value, unescaped
from turtlewire.msg.types import (
    AbstractType,
    Array,
    BasicType,
    BoundedString,
    BoundedWString,
    NamedType,
    NamespacedType,
    UnboundedString,
    UnboundedWString,
    sequence_of,
)

if TYPE_CHECKING:
    from lark import Lark, Tree

__all__ = [
    "BASE_TYPE_SPEC_TO_IDL_TYPE",
    "bounded_by",
    "get_abstract_type",
    "get_abstract_type_from_const_expr",
    "get_abstract_type_from_type_spec",
    "get_abstract_type_optionally_as_array",
    "get_annotations",
    "get_ast_from_idl_string",
    "get_child_identifier_value",
    "get_const_expr_value",
    "get_decimal_literal_value",
    "get_first_identifier_value",
    "get_fixed_pt_literal_value",
    "get_floating_pt_literal_value",
    "get_module_identifier_values",
    "get_positive_int_const",
    "get_string_literal_value",
    "get_string_literals_value",
    "grammar",
    "grammar_file",
    "nodes_of",
]

#: Path of the grammar.
grammar_file = os.path.join(os.path.dirname(__file__), "grammar.lark")
with open(grammar_file, encoding="utf-8") as _file:
    #: Its text.
    grammar = _file.read()

#: Names of types by the rules of the grammar.
BASE_TYPE_SPEC_TO_IDL_TYPE = {
    "signed_tiny_int": "int8",
    "unsigned_tiny_int": "uint8",
    "signed_short_int": "int16",
    "unsigned_short_int": "uint16",
    "signed_long_int": "int32",
    "unsigned_long_int": "uint32",
    "signed_longlong_int": "int64",
    "unsigned_longlong_int": "uint64",
    "float_type": "float",
    "double_type": "double",
    "long_double_type": "long double",
    "char_type": "char",
    "wide_char_type": "wchar",
    "boolean_type": "boolean",
    "octet_type": "octet",
}


@functools.cache
def _parser() -> Lark:
    try:
        from lark import Lark
    except ImportError as error:
        raise ImportError(
            "Syntax trees of IDL need the package lark: pip install 'turtlewire-ros[grammars]'",
            name=error.name,
        ) from error
    return Lark(grammar, start="specification", parser="lalr", maybe_placeholders=False)


def get_ast_from_idl_string(idl_string: str) -> Tree[Any]:
    """Return the syntax tree of a text; its rules have the names of the IDL specification.

    Raises:
        lark.UnexpectedInput: The text is not IDL, or uses a construct of which no interface
            consists.
        ImportError: The package lark is missing.
    """
    return _parser().parse(idl_string)


def nodes_of(tree: Tree[Any]) -> Iterator[Tree[Any]]:
    """Yield all nodes in the order of the text."""
    nodes: Iterator[Tree[Any]] = tree.iter_subtrees_topdown()  # type: ignore[no-untyped-call]
    return nodes


# Names


def get_first_identifier_value(tree: Tree[Any]) -> str:
    """Return the first identifier at any depth of a tree.

    Raises:
        StopIteration: The tree has no identifier.
    """
    nodes = nodes_of(tree)
    return _word(next(node for node in nodes if node.data == "identifier"))


def get_child_identifier_value(tree: Tree[Any]) -> str:
    """Return the identifier among the children of a node, for example the name of a structure.

    Raises:
        StopIteration: No child is an identifier.
    """
    return _word(next(_children(tree, "identifier")))


def get_module_identifier_values(tree: Tree[Any], target: Tree[Any]) -> list[str]:
    """Return the names of the modules around a node, the outermost first.

    Args:
        tree: The whole tree.
        target: A node of it.
    """
    names: list[str] = []
    node = tree
    while node is not target:
        if node.data == "module_dcl":
            names.append(get_child_identifier_value(node))
        inside = (child for child in node.children if hasattr(child, "children"))
        node = next(each for each in inside if any(each is target for each in each.iter_subtrees()))
    return names


# Values


def get_const_expr_value(const_expr: Tree[Any]) -> Any:
    """Return the value of a constant expression: a literal with or without a sign, or a name."""
    *sign, value = const_expr.children
    if value.data == "scoped_name":
        return "::".join(_scope(value))
    (literal,) = value.children
    result = _LITERALS[literal.data](literal)
    return -result if sign and _word(sign[0]) == "-" else result


def get_decimal_literal_value(decimal_literal: Tree[Any]) -> int:
    """Return the value of a whole number."""
    return int(_word(decimal_literal))


def get_floating_pt_literal_value(floating_pt_literal: Tree[Any]) -> float:
    """Return the value of a number with a point or an exponent."""
    return float(_word(floating_pt_literal))


def get_fixed_pt_literal_value(fixed_pt_literal: Tree[Any]) -> float:
    """Return the value of a number of fixed precision, which ends in ``d``."""
    return float(_word(fixed_pt_literal).rstrip("dD"))


def get_positive_int_const(positive_int_const: Tree[Any]) -> int:
    """Return a size.

    Raises:
        ValueError: The size is not a positive integer.
    """
    (expression,) = positive_int_const.children
    value = get_const_expr_value(expression)
    if not isinstance(value, int) or value < 1:
        raise ValueError(f"'{value}' is not a size (a positive integer)")
    return value


def get_string_literals_value(string_literals: Tree[Any], *, allow_unicode: bool = False) -> str:
    """Return the text of string literals that follow each other; see `get_string_literal_value`."""
    return "".join(
        get_string_literal_value(each, allow_unicode=allow_unicode)
        for each in string_literals.children
    )


def get_string_literal_value(string_literal: Tree[Any], *, allow_unicode: bool = False) -> str:
    r"""Return the text of a string literal without quotes and escapes.

    Args:
        string_literal: Its node.
        allow_unicode: Whether ``\u00e9`` is one character, as in literals with an ``L``.
    """
    literal = _word(string_literal)
    text = literal.removeprefix("L")[1:-1]
    if not (allow_unicode or literal.startswith("L")):
        # A further backslash keeps these escapes as they are.
        text = re.sub(r"\\(.)", lambda found: "\\" * (found[1] == "u") + found[0], text)
    return unescaped(text)


_LITERALS: dict[str, Callable[[Tree[Any]], Any]] = {
    "decimal_literal": get_decimal_literal_value,
    "octal_literal": lambda literal: number_value(_word(literal)),
    "hexadecimal_literal": lambda literal: number_value(_word(literal)),
    "floating_pt_literal": get_floating_pt_literal_value,
    "fixed_pt_literal": get_fixed_pt_literal_value,
    "character_literal": lambda literal: unescaped(_word(literal).removeprefix("L")[1:-1]),
    "boolean_literal": lambda literal: _word(literal) == "TRUE",
    "string_literals": functools.partial(get_string_literals_value, allow_unicode=True),
}


def get_annotations(tree: Tree[Any]) -> list[Annotation]:
    """Return the annotations of a definition: each has no value, a value, or values by name."""
    return [
        Annotation(get_first_identifier_value(each), _annotation_value(each))
        for each in _children(tree, "annotation_appl")
    ]


def _annotation_value(annotation: Tree[Any]) -> Any:
    if len(annotation.children) == 1:
        return None
    parameters = annotation.children[1].children
    if parameters[0].data == "const_expr":
        return get_const_expr_value(parameters[0])
    return {
        get_child_identifier_value(each): get_const_expr_value(each.children[1])
        for each in parameters
    }


# Types


def get_abstract_type(tree: Tree[Any]) -> AbstractType:
    """Return the type that a node stands for.

    Args:
        tree: A ``type_spec``, a ``const_type`` or a child of them.

    Raises:
        ValueError: The node does not stand for a type.
    """
    if tree.data == "base_type_spec":
        return BasicType(BASE_TYPE_SPEC_TO_IDL_TYPE[tree.children[0].data])
    if tree.data == "scoped_name":
        *scope, name = _scope(tree)
        return NamespacedType(tuple(scope), name) if scope else NamedType(name)
    if tree.data in ("type_spec", "const_type"):
        return get_abstract_type(tree.children[0])
    sizes = [get_positive_int_const(each) for each in _children(tree, "positive_int_const")]
    if tree.data == "string_type":
        return BoundedString(*sizes) if sizes else UnboundedString()
    if tree.data == "wide_string_type":
        return BoundedWString(*sizes) if sizes else UnboundedWString()
    if tree.data == "sequence_type":
        inner = get_abstract_type(tree.children[0])
        return sequence_of(inner, sizes[0] if sizes else None)
    raise ValueError(f"'{tree.data}' is not a type")


def get_abstract_type_from_type_spec(type_spec: Tree[Any]) -> AbstractType:
    """Return the type of a ``type_spec``."""
    return get_abstract_type(type_spec)


def get_abstract_type_from_const_expr(const_expr: Tree[Any], value: Any) -> AbstractType:
    """Return the type of a constant; a text is bounded by its value.

    Args:
        const_expr: The ``const_type`` of the constant.
        value: The value of the constant.
    """
    return bounded_by(value, get_abstract_type(const_expr))


def bounded_by(value: Any, type_: AbstractType) -> AbstractType:
    """Return the type of a constant: text is bounded by the value, as in ROS 2."""
    if isinstance(type_, UnboundedString):
        return BoundedString(len(value))
    return BoundedWString(len(value)) if isinstance(type_, UnboundedWString) else type_


def get_abstract_type_optionally_as_array(
    abstract_type: AbstractType, declarator: Tree[Any]
) -> AbstractType:
    """Return the type of a declarator: the given one, or an array of it.

    Raises:
        ValueError: The declarator has several sizes.
    """
    brackets = declarator.find_data("fixed_array_size")
    sizes = [get_positive_int_const(each.children[0]) for each in brackets]
    if len(sizes) > 1:
        raise ValueError("an array of arrays is not a valid field")
    return Array(abstract_type, *sizes) if sizes else abstract_type


def _children(tree: Tree[Any], rule: str) -> Any:
    return (each for each in tree.children if getattr(each, "data", None) == rule)


def _word(node: Tree[Any]) -> str:
    return str(node.children[0])


def _scope(scoped_name: Tree[Any]) -> list[str]:
    return [_word(each) for each in scoped_name.children]
