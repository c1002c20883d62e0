"""Reads .idl files: the part of IDL 4.2 of which ROS 2's interfaces consist.

That is includes, modules, structures, constants, typedefs and annotations. Other constructs of
IDL (unions, enums, maps) raise an error with the line.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

from turtlewire.errors import InterfaceError
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

_TOKEN = re.compile(
    r"(?P<include>\#\s*include\s*[<\"](?P<path>[^>\"\n]*)[>\"])"
    r"|(?P<space>\s+|//[^\n]*|/\*.*?\*/|\#[^\n]*)"
    r"|L?(?P<text>\"(?:[^\"\\]|\\.)*\")"
    r"|L?(?P<character>'(?:[^'\\]|\\.[^']*)')"
    r"|(?P<number>[-+]?(?:\d[\w.]*|\.\d\w*)(?:(?<=[eE])[-+]\d+)?)"
    r"|(?P<name>[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)"
    r"|(?P<symbol>[{}()\[\]<>;:,=@])",
    re.DOTALL,
)


class _IdlToken(NamedTuple):
    """A token.

    Attributes:
        kind: ``text``, ``character``, ``number``, ``name``, ``symbol`` or ``end``.
        text: As written, but without the ``L`` of wide texts and characters.
        line: Its line, from 1.
    """

    kind: str
    text: str
    line: int


class _IdlTokens:
    """Steps through the tokens of a file.

    Args:
        label: What errors call the file.
        text: What it holds.

    Attributes:
        includes: The files that it includes.

    Raises:
        InterfaceError: A part is not a token; the message contains the line.
    """

    def __init__(self, label: str, text: str) -> None:
        self._label = label
        self._at = 0
        self.includes: list[str] = []
        self._tokens = self._split(text)

    def peek(self) -> _IdlToken:
        """Return the next token, which stays the next one."""
        return self._tokens[self._at]

    def next(self, kind: str = "") -> _IdlToken:
        """Take the next token.

        Raises:
            InterfaceError: The token is missing or of another kind.
        """
        token = self.peek()
        if token.kind == "end" or (kind and token.kind != kind):
            raise self.error(f"expected a {kind or 'value'}, got '{token.text}'", token.line)
        self._at += 1
        return token

    def take(self, symbol: str) -> bool:
        """Take a symbol if it comes next; returns whether it did."""
        if self.peek().text != symbol:
            return False
        self._at += 1
        return True

    def expect(self, symbol: str) -> None:
        """Take a symbol.

        Raises:
            InterfaceError: Something else comes next.
        """
        if not self.take(symbol):
            token = self.peek()
            raise self.error(f"expected '{symbol}', got '{token.text}'", token.line)

    def error(self, text: str, line: int) -> InterfaceError:
        """Return an error that names the file and a line."""
        return InterfaceError(f"{self._label}, line {line}: {text}")

    def _split(self, text: str) -> list[_IdlToken]:
        tokens = []
        at, line = 0, 1
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                raise self.error(f"cannot read {text[at : at + 10]!r}", line)
            kind = str(match.lastgroup)
            if kind == "include":
                self.includes.append(match["path"])
            elif kind != "space":
                tokens.append(_IdlToken(kind, match[kind], line))
            line += match[0].count("\n")
            at = match.end()
        return [*tokens, _IdlToken("end", "the end of the file", line)]


_WHOLE_NUMBERS = {
    f"{sign}{idl}": f"{short}{bits}"
    for sign, short in (("", "int"), ("unsigned ", "uint"))
    for idl, bits in (("short", 16), ("long", 32), ("long long", 64))
} | {f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
#: Names of types by their names in IDL.
BASIC_TYPES = {name: name for name in ("float", "double", "boolean", "octet")} | _WHOLE_NUMBERS
#: Words that another one may follow in the name of a type.
_BEGINNINGS = ("unsigned", "long", "unsigned long")
_FOLLOWERS = ("short", "long", "double")
_ESCAPE = re.compile(r"\\(?:([0-7]{1,3})|[xu]([0-9a-fA-F]{1,4})|(.))", re.DOTALL)
_ESCAPED = dict(zip("abfnrtv", "\a\b\f\n\r\t\v", strict=True))

#: Annotations in their order: names, each with None, a value, or values by name.
Notes = list[tuple[str, Any]]


class IdlMember(NamedTuple):
    """A field of a structure."""

    type: AbstractType
    name: str
    notes: Notes


class IdlStructure(NamedTuple):
    """A structure, with the names of the modules around it."""

    modules: tuple[str, ...]
    name: str
    notes: Notes
    members: list[IdlMember]


class IdlConstant(NamedTuple):
    """A constant, with the names of the modules around it."""

    modules: tuple[str, ...]
    type: AbstractType
    name: str
    value: Any
    notes: Notes


class IdlReader(_IdlTokens):
    """Reads one file; a subclass may refuse types, and keep values as they are written.

    Args:
        label: What errors call the file.
        text: What it holds.

    Attributes:
        structures: The structures in their order.
        constants: The constants in their order.
        typedefs: Types by the names that typedefs give them.
    """

    #: Types that are not others' names.
    basic_types: ClassVar[Mapping[str, str]] = BASIC_TYPES | {
        name: name for name in ("long double", "char", "wchar")
    }
    #: What errors say about a definition that is not read.
    refusal: ClassVar[str] = "is not read here"

    def __init__(self, label: str, text: str) -> None:
        super().__init__(label, text)
        self.structures: list[IdlStructure] = []
        self.constants: list[IdlConstant] = []
        self.typedefs: dict[str, AbstractType] = {}

    def read(self) -> None:
        """Read the whole file.

        Raises:
            InterfaceError: Something is not read; says in which line.
        """
        while self.peek().kind != "end":
            self._definition(())

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
            type_ = self._type()
            name = self.next("name").text
            self.expect("=")
            self.constants.append(IdlConstant(modules, type_, name, self.literal(), notes))
        elif word.text == "typedef":
            type_ = self._type()
            name = self.next("name").text
            self.typedefs[name] = self.dimension(type_)
        else:
            raise self.error(f"'{word.text}' {self.refusal}", word.line)
        self.expect(";")

    def _structure(self, modules: tuple[str, ...], notes: Notes) -> None:
        structure = IdlStructure(modules, self.next("name").text, notes, [])
        self.structures.append(structure)
        self.expect("{")
        while not self.take("}"):
            notes = self._annotations()
            type_ = self._type()
            while True:
                name = self.next("name").text
                structure.members.append(IdlMember(self.dimension(type_), name, notes))
                if not self.take(","):
                    break
            self.expect(";")

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
            return self.sequence(inner, size, word.line)
        if name in ("string", "wstring"):
            wide = name == "wstring"
            if not self.take("<"):
                return UnboundedWString() if wide else UnboundedString()
            size = self._size()
            self.expect(">")
            return BoundedWString(size) if wide else BoundedString(size)
        if name in self.basic_types:
            return BasicType(self.basic_types[name])
        return self.named_type(name, word.line)

    def sequence(self, inner: AbstractType, size: int | None, line: int) -> AbstractType:  # noqa: ARG002
        """Return the type of a sequence."""
        return sequence_of(inner, size)

    def named_type(self, name: str, line: int) -> AbstractType:  # noqa: ARG002
        """Return the type of a name that is not a basic type."""
        *scope, last = name.split("::")
        return NamespacedType(tuple(scope), last) if scope else NamedType(last)

    def dimension(self, type_: AbstractType) -> AbstractType:
        """Return the type with the number in brackets that may follow a name."""
        if not self.take("["):
            return type_
        size = self._size()
        self.expect("]")
        return Array(type_, size)

    def _size(self) -> int:
        token = self.next("number")
        size = number_value(token.text)
        if not isinstance(size, int) or size < 1:
            raise self.error(f"'{token.text}' is not a size (a positive integer)", token.line)
        return size

    def _annotations(self) -> Notes:
        found = []
        while self.take("@"):
            name = self.next("name").text
            found.append((name, self._annotation_value() if self.take("(") else None))
        return found

    def _annotation_value(self) -> Any:
        """Read the values in parentheses: by name, or one without a name."""
        values = {}
        while not self.take(")"):
            key = self.next("name").text if self.peek().kind == "name" else ""
            if not self.take("="):
                value = self.word(key) if key else self.literal()
                self.expect(")")
                return value
            values[key] = self.literal()
            self.take(",")
        return values

    def word(self, text: str) -> Any:
        """Return the value of a name in the place of a value."""
        return {"TRUE": True, "FALSE": False}.get(text, text)

    def literal(self) -> Any:
        """Read a value; texts that follow each other are one."""
        token = self.next()
        if token.kind == "number":
            value = number_value(token.text)
            if value is not None:
                return value
        elif token.kind == "text":
            parts = [token.text]
            while self.peek().kind == "text":
                parts.append(self.next().text)
            return "".join(unescaped(part[1:-1]) for part in parts)
        elif token.kind == "character":
            return unescaped(token.text[1:-1])
        elif token.text in ("TRUE", "FALSE"):
            return self.word(token.text)
        raise self.error(f"expected a value, got '{token.text}'", token.line)


def number_value(text: str) -> int | float | None:
    """Return the value of a number as IDL writes it; None if it is not a number."""
    sign, digits = (text[0], text[1:]) if text[0] in "+-" else ("", text)
    octal = len(digits) > 1 and digits[0] == "0" and digits.isdigit()
    try:
        if octal or digits[:2].lower() == "0x" or digits.isdigit():
            return int(sign + digits, 8 if octal else 0)
        return float(sign + digits.rstrip("dD"))
    except ValueError:
        return None


def unescaped(text: str) -> str:
    """Return a text with the characters that its escape sequences stand for."""

    def character(match: re.Match[str]) -> str:
        octal, hexadecimal, other = match.groups()
        if other is not None:
            return _ESCAPED.get(other, other)
        return chr(int(octal, 8) if octal else int(hexadecimal, 16))

    return _ESCAPE.sub(character, text)
