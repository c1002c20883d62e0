"""Reads .idl files into the objects of `rosidl_parser.definition`.

The part of IDL is read of which ROS 2's interfaces consist: includes, modules, structures,
constants, typedefs and annotations. Errors name the file and the line.
"""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING, Any, TypeVar

from rosidl_parser.definition import (
    ACTION_FEEDBACK_SUFFIX,
    ACTION_GOAL_SUFFIX,
    ACTION_RESULT_SUFFIX,
    BOOLEAN_TYPE,
    CONSTANT_MODULE_SUFFIX,
    OCTET_TYPE,
    SERVICE_REQUEST_MESSAGE_SUFFIX,
    SERVICE_RESPONSE_MESSAGE_SUFFIX,
    AbstractNestableType,
    AbstractNestedType,
    AbstractType,
    Action,
    Annotatable,
    Annotation,
    Array,
    BasicType,
    BoundedSequence,
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
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)
from turtlewire.errors import InterfaceError
from turtlewire.msg.idl_tokens import IdlTokens

if TYPE_CHECKING:
    from collections.abc import Mapping

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

_WHOLE_NUMBERS = {
    f"{sign}{idl}": f"{short}{bits}"
    for sign, short in (("", "int"), ("unsigned ", "uint"))
    for idl, bits in (("short", 16), ("long", 32), ("long long", 64))
} | {f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_BASIC = {name: name for name in ("float", "double", "long double", "char", "wchar")} | {
    "boolean": BOOLEAN_TYPE,
    "octet": OCTET_TYPE,
    **_WHOLE_NUMBERS,
}
#: Words that another one may follow in the name of a type.
_BEGINNINGS = ("unsigned", "long", "unsigned long")
_FOLLOWERS = ("short", "long", "double")
_ESCAPE = re.compile(r"\\(?:([0-7]{1,3})|[xu]([0-9a-fA-F]{1,4})|(.))", re.DOTALL)
_ESCAPED = dict(zip("abfnrtv", "\a\b\f\n\r\t\v", strict=True))

_Annotated = TypeVar("_Annotated", bound=Annotatable)


def parse_idl_file(locator: IdlLocator, png_file: str | None = None) -> IdlFile:
    """Read a file.

    Args:
        locator: Where it is.
        png_file: ROS 2 draws its syntax tree there; it has no effect here.

    Raises:
        InterfaceError: The file is no interface; its path is printed on stderr, too, as in ROS 2.
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
        InterfaceError: The text is no interface.
    """
    reader = _Reader("idl", idl_string)
    reader.read()
    content = IdlContent()
    content.elements += [Include(path) for path in reader.includes]
    whole = _whole(reader.messages())
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
        # ROS 2 raises this class, too.
        assert type_.name in typedefs, f"Unknown named type: {type_.name}"
        type_ = typedefs[type_.name]
    if isinstance(type_, AbstractNestedType):
        inner = _resolved(type_.value_type, typedefs)
        assert isinstance(inner, AbstractNestableType), "an array of arrays is no field"
        type_.value_type = inner
    return type_


class _Reader(IdlTokens):
    """Reads one file: structures, constants by module, typedefs."""

    def __init__(self, label: str, text: str) -> None:
        super().__init__(label, text)
        self._structures: list[Structure] = []
        self._constants: dict[str, list[Constant]] = {}
        self._typedefs: dict[str, AbstractType] = {}

    def read(self) -> None:
        """Read the whole file."""
        while self.peek().kind != "end":
            self._definition(())

    def messages(self) -> list[Message]:
        """Return the structures with the constants of their modules."""
        messages = []
        for structure in self._structures:
            try:
                resolve_typedefed_names(structure, self._typedefs)
            except AssertionError as error:
                raise InterfaceError(str(error)) from error
            message = Message(structure)
            module = f"{structure.namespaced_type.name}{CONSTANT_MODULE_SUFFIX}"
            message.constants += self._constants.get(module, [])
            messages.append(message)
        return messages

    def _definition(self, modules: tuple[str, ...]) -> None:
        notes = self._annotations()
        word = self.next("name")
        if word.text == "module":
            inner = (*modules, self.next("name").text)
            self.expect("{")
            while not self.take("}"):
                self._definition(inner)
        elif word.text == "struct":
            self._structure(modules, notes)
        elif word.text == "const":
            self._constant(modules, notes)
        elif word.text == "typedef":
            type_ = self._type()
            name = self.next("name").text
            self._typedefs[name] = self._dimension(type_)
        else:
            raise self.error(f"'{word.text}' is not read here", word.line)
        self.expect(";")

    def _structure(self, modules: tuple[str, ...], notes: list[Annotation]) -> None:
        structure = _annotated(Structure(NamespacedType(modules, self.next("name").text)), notes)
        self._structures.append(structure)
        self.expect("{")
        while not self.take("}"):
            notes = self._annotations()
            type_ = self._type()
            while True:
                name = self.next("name").text
                member = _annotated(Member(self._dimension(type_), name), notes)
                structure.members.append(member)
                if not self.take(","):
                    break
            self.expect(";")

    def _constant(self, modules: tuple[str, ...], notes: list[Annotation]) -> None:
        type_ = self._type()
        name = self.next("name").text
        self.expect("=")
        value = self._value()
        if isinstance(type_, UnboundedString):
            type_ = BoundedString(len(value))
        elif isinstance(type_, UnboundedWString):
            type_ = BoundedWString(len(value))
        constant = _annotated(Constant(name, type_, value), notes)
        self._constants.setdefault(modules[-1] if modules else "", []).append(constant)

    def _type(self) -> AbstractType:
        word = self.next("name")
        name = word.text
        while name in _BEGINNINGS and self.peek().text in _FOLLOWERS:
            name = f"{name} {self.next('name').text}"
        if name == "sequence":
            self.expect("<")
            inner = self._type()
            size = self._size() if self.take(",") else None
            self.expect(">")
            return UnboundedSequence(inner) if size is None else BoundedSequence(inner, size)
        if name in ("string", "wstring"):
            wide = name == "wstring"
            if not self.take("<"):
                return UnboundedWString() if wide else UnboundedString()
            size = self._size()
            self.expect(">")
            return BoundedWString(size) if wide else BoundedString(size)
        if name in _BASIC:
            return BasicType(_BASIC[name])
        *scope, last = name.split("::")
        return NamespacedType(tuple(scope), last) if scope else NamedType(last)

    def _dimension(self, type_: AbstractType) -> AbstractType:
        if not self.take("["):
            return type_
        size = self._size()
        self.expect("]")
        return Array(type_, size)

    def _size(self) -> int:
        token = self.next("number")
        size = _number(token.text)
        if not isinstance(size, int) or size < 1:
            raise self.error(f"'{token.text}' is not a size (a positive integer)", token.line)
        return size

    def _annotations(self) -> list[Annotation]:
        found = []
        while self.take("@"):
            name = self.next("name").text
            found.append(Annotation(name, self._annotation_value() if self.take("(") else None))
        return found

    def _annotation_value(self) -> Any:
        """Read the values in parentheses: by name, or one without a name."""
        values = {}
        while not self.take(")"):
            key = self.next("name").text if self.peek().kind == "name" else ""
            if not self.take("="):
                value = {"TRUE": True, "FALSE": False}.get(key, key) if key else self._value()
                self.expect(")")
                return value
            values[key] = self._value()
            self.take(",")
        return values

    def _value(self) -> Any:
        """Return a literal; texts that follow each other are one."""
        token = self.next()
        if token.kind == "number":
            value = _number(token.text)
            if value is not None:
                return value
        elif token.kind == "text":
            parts = [token.text]
            while self.peek().kind == "text":
                parts.append(self.next().text)
            return "".join(_unescaped(part[1:-1]) for part in parts)
        elif token.kind == "character":
            return _unescaped(token.text[1:-1])
        elif token.text in ("TRUE", "FALSE"):
            return token.text == "TRUE"
        raise self.error(f"expected a value, got '{token.text}'", token.line)


def _annotated(thing: _Annotated, notes: list[Annotation]) -> _Annotated:
    thing.annotations += notes
    return thing


def _number(text: str) -> int | float | None:
    """Return the value of a number as IDL writes it; None if it is none."""
    sign, digits = (text[0], text[1:]) if text[0] in "+-" else ("", text)
    octal = len(digits) > 1 and digits[0] == "0" and digits.isdigit()
    try:
        if octal or digits[:2].lower() == "0x" or digits.isdigit():
            return int(sign + digits, 8 if octal else 0)
        return float(sign + digits.rstrip("dD"))
    except ValueError:
        return None


def _unescaped(text: str) -> str:
    def character(match: re.Match[str]) -> str:
        octal, hexadecimal, other = match.groups()
        if other is not None:
            return _ESCAPED.get(other, other)
        return chr(int(octal, 8) if octal else int(hexadecimal, 16))

    return _ESCAPE.sub(character, text)
