"""Interfaces as the text of IDL files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from rosidl_adapter.parser import (
    BaseType,
    MessageSpecification,
    Type,
    parse_action_string,
    parse_message_string,
    parse_service_string,
)

if TYPE_CHECKING:
    from pathlib import Path, PurePath

    from rosidl_adapter.parser import Constant, Field

MSG_TYPE_TO_IDL = {
    "bool": "boolean",
    "byte": "octet",
    "char": "uint8",
    "int8": "int8",
    "uint8": "uint8",
    "int16": "int16",
    "uint16": "uint16",
    "int32": "int32",
    "uint32": "uint32",
    "int64": "int64",
    "uint64": "uint64",
    "float32": "float",
    "float64": "double",
    "string": "string",
    "wstring": "wstring",
}

# IDL has no empty structures; rosidl gives them this member.
_EMPTY = "uint8 structure_needs_at_least_one_member;"


def convert(
    kind: str,
    package_dir: Path,
    package_name: str,
    input_file: Path,
    output_dir: Path,
) -> Path:
    """Write the IDL file, and print what is read and written.

    Args:
        kind: ``msg``, ``srv`` or ``action``, the suffix of the file.
        package_dir: Folder of the package.
        package_name: Its name.
        input_file: Path of the file below the folder.
        output_dir: Folder for the result.

    Returns:
        Path of the result.

    Raises:
        ValueError: A path is not as described.
    """
    if not package_dir.is_absolute() or input_file.is_absolute():
        raise ValueError(f"'{package_dir}' must be absolute, and '{input_file}' relative")
    if input_file.suffix != f".{kind}":
        raise ValueError(f"'{input_file}' does not end in '.{kind}'")
    source = package_dir / input_file
    print(f"Reading input file: {source}")
    text = interface_to_idl(package_name, input_file, source.read_text(encoding="utf-8"))
    target = output_dir / f"{input_file.stem}.idl"
    print(f"Writing output file: {target.absolute()}")
    output_dir.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")
    return target


def interface_to_idl(package: str, source: PurePath, text: str) -> str:
    """Return the IDL of an interface file.

    Args:
        package: Name of the package.
        source: Path of the file below that of the package; its ending is ``.msg``, ``.srv`` or
            ``.action``.
        text: What the file holds.

    Raises:
        ValueError: The text is wrong.
        InvalidSpecification: The text is wrong.
    """
    kind, name = source.suffix[1:], source.stem
    if kind == "msg":
        messages = [parse_message_string(package, name, text)]
    elif kind == "srv":
        service = parse_service_string(package, name, text)
        messages = [service.request, service.response]
    else:
        action = parse_action_string(package, name, text)
        messages = [action.goal, action.result, action.feedback]
    return idl_text(kind, package, source.as_posix(), messages)


def idl_text(kind: str, package: str, source: str, messages: Iterable[MessageSpecification]) -> str:
    """Return the text of a file.

    Args:
        kind: ``msg``, ``srv`` or ``action``.
        package: Name of the package.
        source: Path of the file that was read, below that of the package.
        messages: The messages of which the interface consists.
    """
    parts = list(messages)
    bases = [field.type for message in parts for field in message.fields]
    includes = sorted({name for base in bases if (name := get_include_file(base))})
    lines = [
        # These lines are rosidl_adapter's, so that its output and this one can be compared.
        f"// generated from rosidl_adapter/resource/{kind}.idl.em",
        f"// with input from {package}/{source}",
        "// generated code does not contain a copyright notice",
        "",
        *(f'#include "{name}"' for name in includes),
        "",
        f"module {package} {{",
        f"  module {kind} {{",
        *(line for line in _typedefs(parts)),
    ]
    for message in parts:
        lines += _message(message)
    return "\n".join([*lines, "  };", "};", ""])


def _typedefs(messages: list[MessageSpecification]) -> Iterator[str]:
    """Yield a name for each array type, because in IDL members cannot be arrays."""
    found = {}
    for message in messages:
        for field in message.fields:
            if field.type.is_fixed_size_array():
                name = get_idl_type(field.type)
                element = get_idl_type(BaseType(str(field.type).partition("[")[0]))
                found[name] = f"    typedef {element} {name}[{field.type.array_size}];"
    yield from (found[name] for name in found)


def _message(message: MessageSpecification) -> Iterator[str]:
    name = message.msg_name
    if message.constants:
        yield f"    module {name}_Constants {{"
        for constant in message.constants:
            yield from _annotations(constant, 6)
            kind = get_idl_type(constant.type.partition("<")[0])  # a value needs no bound
            yield f"      const {kind} {constant.name} = {to_idl_literal(kind, constant.value)};"
        yield "    };"
    yield from _annotations(message, 4)
    yield f"    struct {name} {{"
    for index, field in enumerate(message.fields):
        if index:
            yield ""
        yield from _annotations(field, 6)
        yield f"      {get_idl_type(field.type)} {field.name};"
    if not message.fields:
        yield f"      {_EMPTY}"
    yield "    };"


def _annotations(thing: MessageSpecification | Field | Constant, indent: int) -> Iterator[str]:
    space = " " * indent
    comment = thing.annotations.get("comment")
    if comment:
        yield f'{space}@verbatim (language="comment", text='
        last = len(comment) - 1
        for index, line in enumerate(comment):
            end = ")" if index == last else ' "\\n"'
            yield f"{space}  {string_to_idl_string_literal(line)}{end}"
    default = getattr(thing, "default_value", None)
    if default is not None:
        kind = get_idl_type(thing.type)  # type: ignore[union-attr]  # only fields have defaults
        yield f"{space}@default (value={to_idl_literal(kind, default)})"
    if "unit" in thing.annotations:
        yield f"{space}@unit (value={string_to_idl_string_literal(thing.annotations['unit'])})"


def get_include_file(base_type: BaseType) -> str | None:
    """Return a message's file, for example ``std_msgs/msg/Header.idl``; None for other types."""
    if base_type.is_primitive_type():
        return None
    return f"{base_type.pkg_name}/msg/{base_type.type}.idl"


def get_idl_type(type_: BaseType | str) -> str:
    """Return the name of a type in IDL; that of an array is the name of its typedef."""
    if isinstance(type_, str):
        return MSG_TYPE_TO_IDL[type_]
    if type_.is_primitive_type():
        name = MSG_TYPE_TO_IDL[type_.type]
        bound = type_.string_upper_bound
        name += "" if bound is None else f"<{bound}>"
    else:
        name = f"{type_.pkg_name}::msg::{type_.type}"
    if not isinstance(type_, Type) or not type_.is_array:
        return name
    if type_.is_fixed_size_array():
        plain = name.replace("::", "__").replace("<", "_").replace(">", "")
        return f"{plain}__{type_.array_size}"
    bound = type_.array_size
    return f"sequence<{name}>" if bound is None else f"sequence<{name}, {bound}>"


def to_idl_literal(idl_type: str, value: Any) -> str:
    """Return a value in IDL; a list is a text of values in parentheses."""
    if isinstance(value, (list, tuple)):
        # rosidl's convention: IDL has no literals for lists, so `@default` holds a text.
        return string_to_idl_string_literal(f"({', '.join(map(repr, value))})")
    if idl_type == "boolean":
        return "TRUE" if value else "FALSE"
    if idl_type.startswith("string"):
        return string_to_idl_string_literal(value)
    if idl_type.startswith("wstring"):
        return string_to_idl_wstring_literal(value)
    return str(value)


def string_to_idl_string_literal(string: str) -> str:
    """Return a text in quotes."""
    escapes = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    return f'"{"".join(escapes.get(character, character) for character in string)}"'


def string_to_idl_wstring_literal(string: str) -> str:
    """Return a text of wide characters in quotes."""
    return f"L{string_to_idl_string_literal(string)}"
