"""Reads .idl files into the objects of `rosidl_parser.definition`; the engine reads the text."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, TypeVar

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
    BoundedString,
    BoundedWString,
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
from turtlewire.errors import InterfaceError
from turtlewire.msg.idl_reader import IdlReader

if TYPE_CHECKING:
    from collections.abc import Mapping

    from turtlewire.msg.idl_reader import IdlConstant, Notes

__all__ = [
    "ACTION_FEEDBACK_SUFFIX",
    "ACTION_GOAL_SUFFIX",
    "ACTION_RESULT_SUFFIX",
    "CONSTANT_MODULE_SUFFIX",
    "SERVICE_REQUEST_MESSAGE_SUFFIX",
    "SERVICE_RESPONSE_MESSAGE_SUFFIX",
    "parse_idl_file",
    "parse_idl_string",
    "resolve_typedefed_names",
]

_Annotated = TypeVar("_Annotated", bound=Annotatable)


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


def _messages(reader: IdlReader) -> list[Message]:
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
    """Return the type; a text's is bounded by the value."""
    if not isinstance(constant.type, (UnboundedString, UnboundedWString)):
        return constant.type
    if not isinstance(constant.value, str):
        raise InterfaceError(f"the value of '{constant.name}' is no text: {constant.value}")
    if isinstance(constant.type, UnboundedString):
        # As in ROS 2, although a constant needs no bound.
        return BoundedString(len(constant.value))
    return BoundedWString(len(constant.value))


def _annotated(thing: _Annotated, notes: Notes) -> _Annotated:
    thing.annotations += [Annotation(name, value) for name, value in notes]
    return thing
