"""Reads the text of .msg, .srv and .action files.

The grammar is ROS 2's: ``TYPE NAME [DEFAULT]`` is a field, ``TYPE NAME=VALUE`` a constant, ``---``
separates the parts of services and actions, ``#`` starts a comment (not within quotes).
"""

from __future__ import annotations

from collections.abc import Iterator
from keyword import iskeyword
from typing import Any

from turtlewire.errors import InterfaceError
from turtlewire.msg.definition import (
    ActionDefinition,
    Constant,
    Field,
    MessageDefinition,
    ServiceDefinition,
    split_name,
)
from turtlewire.msg.types import (
    INTEGER_RANGES,
    AbstractNestedType,
    AbstractString,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedString,
    UnboundedWString,
    sequence_of,
)

_SEPARATOR = "---"

#: What a quoted value follows.
_BEFORE_VALUE = " \t=[,"

_BASIC_TYPES = {
    "bool": BasicType("boolean"),
    "byte": BasicType("octet"),
    "char": BasicType("uint8"),
    "float32": BasicType("float"),
    "float64": BasicType("double"),
    **{name: BasicType(name) for name in INTEGER_RANGES},
}

#: Attributes that all message classes have.
_TAKEN_NAMES = ("SLOT_TYPES", "get_fields_and_field_types")

_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "0": "\0", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}
_ESCAPES |= {character: character for character in "\"'\\"}


def parse_message(full_name: str, text: str, *, strict: bool = True) -> MessageDefinition:
    """Parse one message.

    Args:
        full_name: ``"geometry_msgs/msg/Vector3"``; the package resolves types named without one.
        text: The text of the file.
        strict: Whether names must follow ROS 2's rules. Definitions in bags come from any tool and
            from ROS 1: there, a field may be called ``D`` or ``class`` (read as ``class_``).

    Returns:
        The definition.

    Raises:
        InterfaceError: The text is not a message; says which line and why.
    """
    package, _, name = split_name(full_name)
    if strict and not _is_type_name(name.partition("_")[0]):
        raise InterfaceError(f"'{name}' is not a valid interface name").with_hint(
            "Interface names are CamelCase: a capital letter, then letters and digits."
        )
    fields: list[Field] = []
    constants: list[Constant] = []
    for number, line in enumerate(text.splitlines(), start=1):
        statement = without_comment(line).strip()
        if statement:
            try:
                _parse_statement(package, statement, fields, constants, strict)
            except ValueError as error:
                raise InterfaceError(
                    f"{full_name}, line {number}: {error} in '{statement}'"
                ) from None
    if not strict:
        names = {field.name for field in fields}
        constants = list({each.name: each for each in constants if each.name not in names}.values())
    _refuse_duplicates(
        full_name, [*(field.name for field in fields), *(constant.name for constant in constants)]
    )
    return MessageDefinition(full_name, tuple(fields), tuple(constants))


def parse_service(full_name: str, text: str) -> ServiceDefinition:
    """Parse one service; see `parse_message`."""
    request, response = _parts(full_name, text, 2)
    return ServiceDefinition(
        full_name,
        parse_message(f"{full_name}_Request", request),
        parse_message(f"{full_name}_Response", response),
    )


def parse_action(full_name: str, text: str) -> ActionDefinition:
    """Parse one action; see `parse_message`."""
    goal, result, feedback = _parts(full_name, text, 3)
    return ActionDefinition(
        full_name,
        parse_message(f"{full_name}_Goal", goal),
        parse_message(f"{full_name}_Result", result),
        parse_message(f"{full_name}_Feedback", feedback),
    )


def _parts(full_name: str, text: str, count: int) -> list[str]:
    parts: list[list[str]] = [[]]
    for line in text.splitlines():
        if line.strip() == _SEPARATOR:
            # Blank lines replace the previous parts, so that errors contain the line of the file.
            parts.append([""] * (len(parts[-1]) + 1))
        else:
            parts[-1].append(line)
    if len(parts) != count:
        raise InterfaceError(
            f"{full_name}: found {len(parts) - 1} lines with '---', expected {count - 1}"
        )
    return ["\n".join(part) for part in parts]


def without_comment(line: str) -> str:
    """Return a line up to the ``#`` that is not within quotes.

    Quotes begin a value; the apostrophe in ``don't`` does not, nor does a quote without an end.
    """
    before, mark, _ = line.partition("#")
    if not mark or ("'" not in before and '"' not in before):
        return before
    quote = ""
    for index, character in enumerate(line):
        if quote:
            if character == quote and line[index - 1] != "\\":
                quote = ""
        elif character == "#":
            return line[:index]
        elif character in "\"'" and line[index - 1] in _BEFORE_VALUE:
            quote = character
    return before if quote else line


def _parse_statement(
    package: str, statement: str, fields: list[Field], constants: list[Constant], strict: bool
) -> None:
    type_text, _, rest = (
        statement.partition(" ")
        if "\t" not in statement
        else statement.replace("\t", " ", 1).partition(" ")
    )
    rest = rest.strip()
    type_ = parse_type(package, type_text, strict=strict)
    name = _leading_identifier(rest)
    value_text = rest[len(name) :].strip()
    if value_text.startswith("="):
        if strict:
            _check_constant_name(name)
        value = parse_value(type_, value_text[1:].strip())
        constants.append(Constant(name if strict else _usable_name(name), type_, value))
        return
    if strict:
        _check_field_name(name)
    else:
        name = _usable_name(name)
    fields.append(Field(name, type_, parse_value(type_, value_text) if value_text else None))


def _usable_name(name: str) -> str:
    """Return the attribute for a name that need not follow ROS 2's rules."""
    if not name.isascii() or not name.isidentifier() or name[0] == "_":
        raise ValueError(f"'{name}' is not a name")
    return f"{name}_" if iskeyword(name) or name in _TAKEN_NAMES else name


def _check_constant_name(name: str) -> None:
    if not name.isupper() or not _is_identifier(name.lower()):
        raise ValueError(
            f"'{name}' is not a valid constant name (capital letters, digits, single underscores)"
        )


def _check_field_name(name: str) -> None:
    if not _is_identifier(name):
        raise ValueError(
            f"'{name}' is not a valid field name (lower case, digits, single underscores, a "
            "letter first)"
        )
    if iskeyword(name):
        raise ValueError(f"'{name}' is a keyword of Python, and so cannot be a field name")


def _leading_identifier(text: str) -> str:
    end = 0
    while end < len(text) and (text[end].isalnum() or text[end] == "_"):
        end += 1
    return text[:end]


def _is_identifier(name: str) -> bool:
    return (
        name.isascii()
        and name.isidentifier()
        and name == name.lower()
        and name[0] != "_"
        and name[-1] != "_"
        and "__" not in name
    )


def _is_type_name(name: str) -> bool:
    return name.isascii() and name[:1].isupper() and name.isalnum()


def parse_type(package: str, text: str, *, strict: bool = True) -> AbstractType:
    """Return the type that a text names, for example ``string<=3[]``.

    Args:
        package: Where messages are that are named without a package.
        text: The text.
        strict: Whether names of messages must follow ROS 2's rules.

    Raises:
        ValueError: ``text`` is not a type.
    """
    if not text.endswith("]"):
        return _parse_value_type(package, text, strict)
    base, _, size = text[:-1].rpartition("[")
    value_type = _parse_value_type(package, base, strict)
    if not size:
        return sequence_of(value_type, None)
    if size.startswith("<="):
        return sequence_of(value_type, _parse_size(size[2:]))
    return Array(value_type, _parse_size(size))


def _parse_value_type(package: str, text: str, strict: bool) -> AbstractType:
    basic = _BASIC_TYPES.get(text)
    if basic is not None:
        return basic
    if text == "string":
        return UnboundedString()
    if text == "wstring":
        return UnboundedWString()
    base, bounded, size = text.partition("<=")
    if bounded and base == "string":
        return BoundedString(_parse_size(size))
    if bounded and base == "wstring":
        return BoundedWString(_parse_size(size))
    owner, slash, name = text.rpartition("/")
    owner = owner.removesuffix("/msg") if slash else package
    is_valid = _is_type_name(name) and _is_identifier(owner or "_")
    if not (is_valid if strict else name.isidentifier() and owner.isidentifier()):
        raise ValueError(f"'{text}' is not a type")
    return NamespacedType((owner, "msg"), name)


def _parse_size(text: str) -> int:
    if not text.isdecimal() or int(text) == 0:
        raise ValueError(f"'{text}' is not a size (a positive integer)")
    return int(text)


def parse_value(type_: AbstractType, text: str) -> Any:
    """Return the value that a text means, for defaults and constants.

    Raises:
        ValueError: ``text`` is not a value of the type.
    """
    if isinstance(type_, AbstractNestedType):
        if not (text.startswith("[") and text.endswith("]")):
            raise ValueError(f"'{text}' is not a list of values ([a, b])")
        values = [parse_value(type_.value_type, item) for item in _split_list(text[1:-1])]
        limit = getattr(type_, "maximum_size", getattr(type_, "size", None))
        if limit is not None and (
            len(values) > limit or (isinstance(type_, Array) and len(values) != limit)
        ):
            raise ValueError(f"{len(values)} values do not fit {type_}")
        return values
    if isinstance(type_, (AbstractString, AbstractWString)):
        value = _unquote(text)
        size = len(value.encode() if isinstance(type_, AbstractString) else value)
        if type_.has_maximum_size() and size > type_.maximum_size:  # type: ignore[union-attr]
            raise ValueError(f"'{value}' is longer than {type_}")
        return value
    if not isinstance(type_, BasicType):
        # ValueError becomes the InterfaceError with the line.
        raise ValueError(f"{type_} cannot have a value")  # noqa: TRY004
    return _parse_basic_value(type_.typename, text)


def _parse_basic_value(typename: str, text: str) -> Any:
    if typename == "boolean":
        if text.lower() not in ("true", "false", "1", "0"):
            raise ValueError(f"'{text}' is not a bool")
        return text.lower() in ("true", "1")
    if typename in ("float", "double"):
        return float(text)
    # As in ROS 2, 010 is ten.
    number = int(text) if text.lstrip("+-").isdecimal() else int(text, 0)
    low, high = INTEGER_RANGES.get(typename, (0, 255))
    if not low <= number <= high:
        raise ValueError(f"{number} is outside of {typename} ({low} to {high})")
    return bytes([number]) if typename == "octet" else number


def _split_list(text: str) -> Iterator[str]:
    quote = ""
    item = ""
    for character in text:
        if quote:
            quote = "" if character == quote and not item.endswith("\\") else quote
        elif character in "\"'":
            quote = character
        elif character == ",":
            yield item.strip()
            item = ""
            continue
        item += character
    if item.strip():
        yield item.strip()


def _unquote(text: str) -> str:
    if len(text) < 2 or text[0] != text[-1] or text[0] not in "\"'":
        return text
    out: list[str] = []
    characters = iter(text[1:-1])
    for character in characters:
        if character == "\\":
            escaped = next(characters, "\\")
            out.append(_ESCAPES.get(escaped, f"\\{escaped}"))  # "C:\\dir" has no escape
        else:
            out.append(character)
    return "".join(out)


def _refuse_duplicates(full_name: str, names: list[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise InterfaceError(f"{full_name}: the name '{name}' is used twice")
        seen.add(name)
