"""Reads .idl files into the objects of `rosidl_parser.definition`; the engine reads the text."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from rosidl_parser.definition import (
    ACTION_FEEDBACK_SUFFIX,
    ACTION_GOAL_SUFFIX,
    ACTION_RESULT_SUFFIX,
    CONSTANT_MODULE_SUFFIX,
    SERVICE_REQUEST_MESSAGE_SUFFIX,
    SERVICE_RESPONSE_MESSAGE_SUFFIX,
    AbstractNestableType,
    AbstractNestedType,
    AbstractType,
    Action,
    Annotatable,
    Annotation,
    Constant,
    IdlContent,
    IdlFile,
    IdlLocator,
    Include,
    Member,
    Message,
    NamedType,
    NamespacedType,
    Service,
    Structure,
    UnboundedString,
    UnboundedWString,
)
from rosidl_parser.syntax_tree import (
    BASE_TYPE_SPEC_TO_IDL_TYPE,
    bounded_by,
    get_abstract_type,
    get_abstract_type_from_const_expr,
    get_abstract_type_from_type_spec,
    get_abstract_type_optionally_as_array,
    get_annotations,
    get_ast_from_idl_string,
    get_child_identifier_value,
    get_const_expr_value,
    get_decimal_literal_value,
    get_first_identifier_value,
    get_fixed_pt_literal_value,
    get_floating_pt_literal_value,
    get_module_identifier_values,
    get_positive_int_const,
    get_string_literal_value,
    get_string_literals_value,
    grammar,
    grammar_file,
    nodes_of,
)
from turtlewire.errors import InterfaceError
from turtlewire.msg.idl_reader import IdlConstant, IdlMember, IdlReader, IdlStructure

if TYPE_CHECKING:
    from lark import Tree

    from turtlewire.msg.idl_reader import Notes

__all__ = [
    "ACTION_FEEDBACK_SUFFIX",
    "ACTION_GOAL_SUFFIX",
    "ACTION_RESULT_SUFFIX",
    "BASE_TYPE_SPEC_TO_IDL_TYPE",
    "CONSTANT_MODULE_SUFFIX",
    "SERVICE_REQUEST_MESSAGE_SUFFIX",
    "SERVICE_RESPONSE_MESSAGE_SUFFIX",
    "add_message_members",
    "extract_content_from_ast",
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
    "parse_idl_file",
    "parse_idl_string",
    "resolve_typedefed_names",
]

_Annotated = TypeVar("_Annotated", bound=Annotatable)


class _Definitions(NamedTuple):
    """The definitions of a file, from its text or its syntax tree."""

    includes: list[str]
    structures: list[IdlStructure]
    constants: list[IdlConstant]
    typedefs: dict[str, AbstractType]


def parse_idl_file(locator: IdlLocator, png_file: str | None = None) -> IdlFile:
    """Read a file.

    Args:
        locator: Where it is.
        png_file: ROS 2 draws its syntax tree there; it has no effect here.

    Raises:
        InterfaceError: The file is not an interface; its path is also printed on stderr, as in ROS
            2.
        OSError: The file cannot be read.
    """
    text = locator.get_absolute_path().read_text(encoding="utf-8")
    try:
        content = parse_idl_string(text, png_file=png_file)
    except InterfaceError as error:
        print(error, locator.get_absolute_path(), file=sys.stderr)  # noqa: T201  as ROS 2
        raise
    return IdlFile(locator, content)


def parse_idl_string(idl_string: str, png_file: str | None = None) -> IdlContent:  # noqa: ARG001
    """Read the text of a file.

    Args:
        idl_string: The text.
        png_file: As in :func:`parse_idl_file`.

    Returns:
        Its includes, and one message, service or action.

    Raises:
        InterfaceError: The text is not an interface.
    """
    reader = IdlReader("idl", idl_string)
    reader.read()
    return _content(_Definitions(**{part: getattr(reader, part) for part in _Definitions._fields}))


def extract_content_from_ast(tree: Tree[Any]) -> IdlContent:
    """Return the content of the syntax tree of a file; see `parse_idl_string`.

    Args:
        tree: The result of `get_ast_from_idl_string`.

    Raises:
        InterfaceError: The definitions are not an interface.
    """
    found = _Definitions([], [], [], {})
    # From the top to the bottom of the file, since it defines names before their use.
    for node in nodes_of(tree):
        modules = tuple(get_module_identifier_values(tree, node)) if node.data in _DEFINED else ()
        if node.data == "include_directive":
            found.includes.append(str(node.children[0])[1:-1])
        elif node.data == "typedef_dcl":
            found.typedefs.update((name, type_) for type_, name in _declared(node))
        elif node.data == "struct_def":
            members = _members(node)
            name = get_child_identifier_value(node)
            found.structures.append(IdlStructure(modules, name, _notes(node), members))
        elif node.data == "const_dcl":
            *_, type_, _, value = node.children
            name = get_child_identifier_value(node)
            constant = get_abstract_type(type_), name, get_const_expr_value(value), _notes(node)
            found.constants.append(IdlConstant(modules, *constant))
    return _content(found)


#: The rules of definitions that have a name within modules.
_DEFINED = ("struct_def", "const_dcl")


def add_message_members(msg: Message, tree: Tree[Any]) -> None:
    """Add the fields of a structure to a message.

    Args:
        msg: Its structure gets the fields.
        tree: The ``struct_def``.
    """
    msg.structure.members += [
        _annotated(Member(each.type, each.name), each.notes) for each in _members(tree)
    ]


def _members(structure: Tree[Any]) -> list[IdlMember]:
    return [
        IdlMember(type_, name, _notes(member))
        for member in structure.children
        if getattr(member, "data", "") == "member"
        for type_, name in _declared(member)
    ]


def _declared(tree: Tree[Any]) -> Iterator[tuple[AbstractType, str]]:
    """Yield the types and names of the declarators of a member or typedef."""
    *_, type_spec, declarators = tree.children
    for declarator in declarators.children:
        type_ = get_abstract_type_from_type_spec(type_spec)
        name = get_first_identifier_value(declarator)
        yield get_abstract_type_optionally_as_array(type_, declarator), name


def _notes(tree: Tree[Any]) -> Notes:
    return [(each.name, each.value) for each in get_annotations(tree)]


def _content(reader: _Definitions) -> IdlContent:
    content = IdlContent()
    content.elements += [Include(path) for path in reader.includes]
    whole = _whole(_messages(reader))
    if isinstance(whole, Action):
        content.elements += [
            each for each in whole.implicit_includes if each.locator not in reader.includes
        ]
    content.elements.append(whole)
    return content


def _whole(messages: list[Message]) -> Message | Service | Action:
    """Return the interface that structures form by their names."""
    names = [message.structure.namespaced_type.name for message in messages]
    modules = {message.structure.namespaced_type.namespaces for message in messages}
    parts = {
        1: ("",),
        2: (SERVICE_REQUEST_MESSAGE_SUFFIX, SERVICE_RESPONSE_MESSAGE_SUFFIX),
        3: (ACTION_GOAL_SUFFIX, ACTION_RESULT_SUFFIX, ACTION_FEEDBACK_SUFFIX),
    }.get(len(messages), ())
    stem = names[0].removesuffix(parts[0]) if parts else ""
    if not parts or names != [f"{stem}{suffix}" for suffix in parts] or len(modules) > 1:
        raise InterfaceError(
            "expected the structures of one message, service or action, got "
            f"{', '.join(names) or 'none'}"
        )
    name = NamespacedType(modules.pop(), stem)
    if len(messages) == 1:
        return messages[0]
    return Service(name, *messages) if len(messages) == 2 else Action(name, *messages)


def resolve_typedefed_names(structure: Structure, typedefs: Mapping[str, AbstractType]) -> None:
    """Put the types that typedefs stand for in the place of their names.

    Args:
        structure: Its members are changed.
        typedefs: The types by name.

    Raises:
        AssertionError: A name has no type, or stands for an array within a sequence or array.
    """
    for member in structure.members:
        member.type = _resolved(member.type, typedefs)


def _resolved(type_: AbstractType, typedefs: Mapping[str, AbstractType]) -> AbstractType:
    while isinstance(type_, NamedType):
        # As in ROS 2, an AssertionError.
        assert type_.name in typedefs, f"Unknown named type: {type_.name}"
        type_ = typedefs[type_.name]
    if isinstance(type_, AbstractNestedType):
        inner = _resolved(type_.value_type, typedefs)
        assert isinstance(inner, AbstractNestableType), "an array of arrays is not a valid field"
        type_.value_type = inner
    return type_


def _messages(reader: _Definitions) -> list[Message]:
    """Return the structures with the constants of their modules."""
    messages = []
    for modules, name, notes, members in reader.structures:
        structure = _annotated(Structure(NamespacedType(modules, name)), notes)
        structure.members += [
            _annotated(Member(each.type, each.name), each.notes) for each in members
        ]
        try:
            resolve_typedefed_names(structure, reader.typedefs)
        except AssertionError as error:
            raise InterfaceError(str(error)) from error
        message = Message(structure)
        message.constants += [
            _annotated(Constant(each.name, _type_of_constant(each), each.value), each.notes)
            for each in reader.constants
            if each.modules[-1:] == (f"{name}{CONSTANT_MODULE_SUFFIX}",)
        ]
        messages.append(message)
    return messages


def _type_of_constant(constant: IdlConstant) -> AbstractType:
    is_text = isinstance(constant.type, (UnboundedString, UnboundedWString))
    if is_text and not isinstance(constant.value, str):
        raise InterfaceError(f"the value of '{constant.name}' is no text: {constant.value}")
    return bounded_by(constant.value, constant.type)


def _annotated(thing: _Annotated, notes: Notes) -> _Annotated:
    thing.annotations += [Annotation(name, value) for name, value in notes]
    return thing
