"""Reads ``.msg``, ``.srv`` and ``.action`` files, with their comments.

The engine's parser (:mod:`turtlewire.msg.parser`) leaves comments out; IDL files have them. It
parses the values here, and reports where comments begin.
"""

from __future__ import annotations

import itertools
import os
import re
import textwrap
from collections.abc import Collection
from typing import Any

from rosidl_adapter.specification import (
    PRIMITIVE_TYPES,
    ActionSpecification,
    BaseType,
    Constant,
    Field,
    InvalidActionSpecification,
    InvalidFieldDefinition,
    InvalidResourceName,
    InvalidServiceSpecification,
    InvalidSpecification,
    InvalidValue,
    MessageSpecification,
    ServiceSpecification,
    Type,
    UnknownMessageType,
    is_valid_constant_name,
    is_valid_field_name,
    is_valid_message_name,
    is_valid_package_name,
    parse_value_string,
)
from turtlewire.msg.parser import without_comment

__all__ = [
    "ACTION_FEEDBACK_MESSAGE_SUFFIX",
    "ACTION_FEEDBACK_SUFFIX",
    "ACTION_GOAL_SERVICE_SUFFIX",
    "ACTION_GOAL_SUFFIX",
    "ACTION_REQUEST_RESPONSE_SEPARATOR",
    "ACTION_RESULT_SERVICE_SUFFIX",
    "ACTION_RESULT_SUFFIX",
    "ARRAY_UPPER_BOUND_TOKEN",
    "COMMENT_DELIMITER",
    "CONSTANT_SEPARATOR",
    "PACKAGE_NAME_MESSAGE_TYPE_SEPARATOR",
    "PRIMITIVE_TYPES",
    "SERVICE_EVENT_MESSAGE_SUFFIX",
    "SERVICE_REQUEST_MESSAGE_SUFFIX",
    "SERVICE_REQUEST_RESPONSE_SEPARATOR",
    "SERVICE_RESPONSE_MESSAGE_SUFFIX",
    "STRING_UPPER_BOUND_TOKEN",
    "ActionSpecification",
    "BaseType",
    "Constant",
    "Field",
    "InvalidActionSpecification",
    "InvalidFieldDefinition",
    "InvalidResourceName",
    "InvalidServiceSpecification",
    "InvalidSpecification",
    "InvalidValue",
    "MessageSpecification",
    "ServiceSpecification",
    "Type",
    "UnknownMessageType",
    "extract_file_level_comments",
    "find_matching_end_quote",
    "is_valid_constant_name",
    "is_valid_field_name",
    "is_valid_message_name",
    "is_valid_package_name",
    "parse_action_file",
    "parse_action_string",
    "parse_message_file",
    "parse_message_string",
    "parse_primitive_value_string",
    "parse_service_file",
    "parse_service_string",
    "parse_string_array_value_string",
    "parse_value_string",
    "process_comments",
    "validate_field_types",
]

COMMENT_DELIMITER = "#"
CONSTANT_SEPARATOR = "="
ARRAY_UPPER_BOUND_TOKEN = STRING_UPPER_BOUND_TOKEN = "<="  # noqa: S105  a token of the grammar
PACKAGE_NAME_MESSAGE_TYPE_SEPARATOR = "/"
SERVICE_REQUEST_RESPONSE_SEPARATOR = ACTION_REQUEST_RESPONSE_SEPARATOR = "---"
SERVICE_REQUEST_MESSAGE_SUFFIX = "_Request"
SERVICE_RESPONSE_MESSAGE_SUFFIX = "_Response"
SERVICE_EVENT_MESSAGE_SUFFIX = "_Event"
ACTION_GOAL_SUFFIX = ACTION_GOAL_SERVICE_SUFFIX = "_Goal"
ACTION_RESULT_SUFFIX = ACTION_RESULT_SERVICE_SUFFIX = "_Result"
ACTION_FEEDBACK_SUFFIX = ACTION_FEEDBACK_MESSAGE_SUFFIX = "_Feedback"

#: A unit in brackets; with a comma it is a range.
_UNIT = re.compile(r"\s*\[([^,\]]+)\]")


def parse_message_file(pkg_name: str, interface_filename: str) -> MessageSpecification:
    """Return a message from a file, whose name is that of the message."""
    return parse_message_string(pkg_name, *_read(interface_filename))


def parse_service_file(pkg_name: str, interface_filename: str) -> ServiceSpecification:
    """Return a service from a file, whose name is that of the service."""
    return parse_service_string(pkg_name, *_read(interface_filename))


def parse_action_file(pkg_name: str, interface_filename: str) -> ActionSpecification:
    """Return an action from a file, whose name is that of the action."""
    return parse_action_string(pkg_name, *_read(interface_filename))


def _read(path: str) -> tuple[str, str]:
    with open(path, encoding="utf-8") as file:
        return os.path.splitext(os.path.basename(path))[0], file.read()


def parse_service_string(pkg_name: str, srv_name: str, message_string: str) -> ServiceSpecification:
    """Return a service from a text.

    Raises:
        InvalidServiceSpecification: There is not exactly one line ``---``.
        InvalidSpecification: See `parse_message_string`.
    """
    parts = _parts(message_string)
    if len(parts) != 2:
        raise InvalidServiceSpecification(
            f"Number of '{SERVICE_REQUEST_RESPONSE_SEPARATOR}' separators nonconformant with "
            "service definition"
        )
    names = (SERVICE_REQUEST_MESSAGE_SUFFIX, SERVICE_RESPONSE_MESSAGE_SUFFIX)
    request, response = (
        parse_message_string(pkg_name, f"{srv_name}{suffix}", part)
        for suffix, part in zip(names, parts, strict=True)
    )
    return ServiceSpecification(pkg_name, srv_name, request, response)


def parse_action_string(pkg_name: str, action_name: str, action_string: str) -> ActionSpecification:
    """Return an action from a text.

    Raises:
        InvalidActionSpecification: There are not exactly two lines ``---``.
        InvalidSpecification: See `parse_message_string`.
    """
    parts = _parts(action_string)
    if len(parts) != 3:
        raise InvalidActionSpecification(
            f"Number of '{ACTION_REQUEST_RESPONSE_SEPARATOR}' separators nonconformant with "
            "action definition"
        )
    names = (ACTION_GOAL_SUFFIX, ACTION_RESULT_SUFFIX, ACTION_FEEDBACK_SUFFIX)
    goal, result, feedback = (
        parse_message_string(pkg_name, f"{action_name}{suffix}", part)
        for suffix, part in zip(names, parts, strict=True)
    )
    return ActionSpecification(pkg_name, action_name, goal, result, feedback)


def _parts(text: str) -> list[str]:
    # Only a whole line separates: `---` may also occur in a comment or string.
    groups = itertools.groupby(text.splitlines(), lambda line: line != "---")
    parts = [""]
    for is_content, lines in groups:
        if is_content:
            parts[-1] = "\n".join(lines)
        else:
            parts += [""] * len(list(lines))
    return parts


def parse_message_string(pkg_name: str, msg_name: str, message_string: str) -> MessageSpecification:
    """Return a message from a text.

    A comment belongs to the field or constant after it; an indented one to the one before. The
    lines at the beginning belong to the message.

    Raises:
        InvalidFieldDefinition: A line has a type and no name.
        InvalidSpecification: A type is not valid.
        NameError: A name is not valid.
        InvalidValue: A default or a value does not fit its type.
        ValueError: Two fields or constants have the same name.
    """
    # As in ROS 2, which knows only the space as separator.
    comments, lines = extract_file_level_comments(message_string.replace("\t", " "))
    named: list[Field | Constant] = []
    waiting: list[str] = []
    for line in map(str.rstrip, lines):
        content = without_comment(line)
        mark, comment = line[len(content) :][:1], line[len(content) + 1 :]
        # An indented comment on its own line continues the previous line's comment.
        if mark and content and not content.strip():
            if named:
                named[-1].annotations["comment"].append(comment.lstrip(COMMENT_DELIMITER))
            continue
        if mark:
            waiting.append(comment.lstrip(COMMENT_DELIMITER))
        if content.strip():
            named.append(_named(pkg_name, content.rstrip()))
            named[-1].annotations["comment"] = waiting
            waiting = []
    message = MessageSpecification(
        pkg_name,
        msg_name,
        [each for each in named if isinstance(each, Field)],
        [each for each in named if isinstance(each, Constant)],
    )
    message.annotations["comment"] = comments
    for each in (message, *named):
        process_comments(each)
    return message


def _named(pkg_name: str, line: str) -> Field | Constant:
    type_string, _, rest = line.partition(" ")
    rest = rest.lstrip()
    if not rest:
        raise InvalidFieldDefinition(line)
    name, separator, value = rest.partition(CONSTANT_SEPARATOR)
    if separator:
        return Constant(type_string, name.rstrip(), value.lstrip())
    name, _, default = rest.partition(" ")
    return Field(Type(type_string, pkg_name), name, default.lstrip() or None)


def extract_file_level_comments(message_string: str) -> tuple[list[str], list[str]]:
    """Return the comment lines at the beginning, without their ``#``, and the lines behind them."""
    lines = message_string.splitlines()
    count = len(list(itertools.takewhile(lambda line: line.startswith(COMMENT_DELIMITER), lines)))
    return [line.lstrip(COMMENT_DELIMITER) for line in lines[:count]], lines[count:]


def process_comments(instance: MessageSpecification | Field | Constant) -> None:
    """Tidy the comment: take the unit out of it, and blank lines and common indentation."""
    lines: list[str] = instance.annotations.get("comment", [])
    # Over all lines, because only a single unit counts.
    units = _UNIT.findall("\n".join(lines))
    if len(units) == 1:
        instance.annotations["unit"] = units[0]
        lines = [_UNIT.sub("", line) for line in lines]
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip("\n")
    instance.annotations["comment"] = textwrap.dedent(text).split("\n") if text else []


def validate_field_types(spec: Any, known_msg_types: Collection[Any]) -> None:
    """Check that messages of which a message, service or action consists are known.

    Args:
        spec: A message, service or action.
        known_msg_types: The base types of the known messages.

    Raises:
        UnknownMessageType: One is not.
    """
    parts = ("request", "response", "goal", "result", "feedback")
    messages = [spec] if isinstance(spec, MessageSpecification) else []
    messages += [getattr(spec, part) for part in parts if hasattr(spec, part)]
    known = {str(each) for each in known_msg_types}
    for message in messages:
        for field in message.fields:
            base = f"{field.type.pkg_name}/{field.type.type}"
            if not field.type.is_primitive_type() and base not in known:
                raise UnknownMessageType(
                    f"Message '{message.base_type}' contains unknown field type: '{field}'"
                )


def parse_primitive_value_string(type_: BaseType, value_string: str) -> Any:
    """Return the value of a text that is not a list.

    Raises:
        InvalidValue: The text is not a value of the type.
    """
    return parse_value_string(Type(str(type_)), value_string)


def parse_string_array_value_string(
    element_string: str,
    expected_size: int | None,  # noqa: ARG001 - as in ROS 2, the caller compares the sizes
) -> list[str]:
    """Return the elements of a list of strings, which is written without its brackets.

    Quotes are removed, and escaped quotes within them are quotes.

    Args:
        element_string: The elements, separated by commas.
        expected_size: Ignored.

    Raises:
        ValueError: An element is missing, or a quote has no end.
    """
    values: list[str] = []
    rest = element_string.lstrip()
    while rest:
        quote = rest[0]
        if quote == ",":
            # ROS 2's text, to the byte.
            raise ValueError(f"unxepected ',' at beginning of [{rest}]")
        if quote in "'\"":
            end = find_matching_end_quote(rest, quote)
            if end == -1:
                raise ValueError(f"string [{rest}] incorrectly quoted\n{values}")
            values.append(rest[1 : end + 1].replace(f"\\{quote}", quote))
            rest = rest[end + 2 :].lstrip().removeprefix(",")
        else:
            value, _, rest = rest.partition(",")
            values.append(value)
        rest = rest.lstrip()
    return values


def find_matching_end_quote(string: str, quote: str) -> int:
    """Return the length of a quoted text, without the quotes.

    Args:
        string: Begins with the quote before the text.
        quote: The character that ends the text unless a backslash precedes it.

    Returns:
        The length, or -1 if the text has no end.
    """
    found = re.compile(rf"(?<!\\){re.escape(quote)}").search(string, 1)
    return -1 if found is None else found.start() - 1
