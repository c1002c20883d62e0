"""Translates .idl files of interfaces into the text of .msg, .srv and .action files.

The part of IDL 4.2 is read that ROS 2's interfaces use: modules, structures, constants, typedefs of
arrays, annotations with defaults and comments. Whatever else IDL has (unions, enums, maps) cannot
be said in a .msg file, and is refused with its line.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from turtlewire.errors import InterfaceError

__all__ = ["idl_to_text"]

_TOKEN = re.compile(
    r"(?P<space>\s+|//[^\n]*|/\*.*?\*/|#[^\n]*)"
    r"|(?P<text>\"(?:[^\"\\]|\\.)*\")"
    r"|(?P<number>[-+]?(?:\d[\w.]*(?:(?<=[eE])[-+]\d+)?|\.\d+))"
    r"|(?P<name>[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)"
    r"|(?P<symbol>[{}()\[\]<>;:,=@])",
    re.DOTALL,
)
_BASIC = {
    "boolean": "bool",
    "octet": "byte",
    "float": "float32",
    "double": "float64",
    "short": "int16",
    "long": "int32",
    "long long": "int64",
    "unsigned short": "uint16",
    "unsigned long": "uint32",
    "unsigned long long": "uint64",
    **{f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}
_PARTS = {
    "msg": ("",),
    "srv": ("_Request", "_Response"),
    "action": ("_Goal", "_Result", "_Feedback"),
}
#: What ROS 2 puts into a structure without fields, which IDL does not allow.
_DUMMY = "structure_needs_at_least_one_member"


class _Token(NamedTuple):
    kind: str
    text: str
    line: int


def idl_to_text(full_name: str, text: str) -> str:
    """Translate an .idl file.

    Args:
        full_name: ``"pkg/msg/X"``, ``"pkg/srv/X"`` or ``"pkg/action/X"``.
        text: What the file holds.

    Returns:
        What ``X.msg``, ``X.srv`` or ``X.action`` would hold.

    Raises:
        InterfaceError: The text cannot be translated; says which line and why.
    """
    _, kind, name = full_name.split("/")
    reader = _Reader(full_name, text)
    reader.read()
    parts = []
    for suffix in _PARTS[kind]:
        if f"{name}{suffix}" not in reader.structures:
            raise InterfaceError(f"{full_name}.idl has no struct {name}{suffix}")
        lines = [
            *reader.comments.get(f"{name}{suffix}", []),
            *reader.constants.get(f"{name}{suffix}", []),
            *reader.structures[f"{name}{suffix}"],
        ]
        parts.append("".join(f"{line}\n" for line in lines))
    return "---\n".join(parts)


class _Reader:
    """Reads one file; the lines for .msg files are in its attributes, by structure."""

    def __init__(self, full_name: str, text: str) -> None:
        self._full_name = full_name
        self._tokens = list(self._split(text))
        self._at = 0
        self._typedefs: dict[str, tuple[str, str]] = {}
        self.structures: dict[str, list[str]] = {}
        self.constants: dict[str, list[str]] = {}
        self.comments: dict[str, list[str]] = {}

    def read(self) -> None:
        """Read the whole file."""
        while self._peek().kind != "end":
            self._definition("")

    def _split(self, text: str) -> list[_Token]:
        tokens = []
        at, line = 0, 1
        while at < len(text):
            match = _TOKEN.match(text, at)
            if match is None:
                raise self._error(f"cannot read {text[at : at + 10]!r}", line)
            if match.lastgroup != "space":
                tokens.append(_Token(str(match.lastgroup), match[0], line))
            line += match[0].count("\n")
            at = match.end()
        return [*tokens, _Token("end", "the end of the file", line)]

    def _definition(self, module: str) -> None:
        notes = self._annotations()
        word = self._next("name")
        if word.text == "module":
            name = self._next("name").text
            self._expect("{")
            while not self._take("}"):
                self._definition(name)
        elif word.text == "struct":
            self._structure(notes)
        elif word.text == "const":
            self._constant(module)
        elif word.text == "typedef":
            type_, suffix = self._type()
            name = self._next("name").text
            self._typedefs[name] = (type_, suffix + self._dimension())
        else:
            raise self._error(f"'{word.text}' has no counterpart in .msg files", word.line)
        self._expect(";")

    def _structure(self, notes: dict[str, str]) -> None:
        name = self._next("name").text
        self.comments[name] = [f"# {line}" for line in notes.get("verbatim", "").splitlines()]
        fields = self.structures.setdefault(name, [])
        self._expect("{")
        while not self._take("}"):
            default = self._annotations().get("default", "")
            type_, suffix = self._type()
            while True:
                field = self._next("name").text
                whole = type_ + suffix + self._dimension()
                if field != _DUMMY:
                    fields.append(f"{whole} {field} {_value(whole, default)}".rstrip())
                if not self._take(","):
                    break
            self._expect(";")

    def _constant(self, module: str) -> None:
        type_, _ = self._type()
        name = self._next("name").text
        self._expect("=")
        lines = self.constants.setdefault(module.removesuffix("_Constants"), [])
        lines.append(f"{type_} {name} = {self._literal()}")

    def _type(self) -> tuple[str, str]:
        """A type, and the brackets that follow it in a .msg file."""
        word = self._next("name")
        name = word.text
        while name in ("unsigned", "long", "unsigned long") and self._peek().text in (
            "short",
            "long",
        ):
            name = f"{name} {self._next('name').text}"
        if name == "sequence":
            self._expect("<")
            inner, suffix = self._type()
            size = f"<={self._next('number').text}" if self._take(",") else ""
            self._expect(">")
            if suffix:
                raise self._error("a sequence of sequences has no counterpart", word.line)
            return inner, f"[{size}]"
        if name in ("string", "wstring"):
            if not self._take("<"):
                return name, ""
            size = self._next("number").text
            self._expect(">")
            return f"{name}<={size}", ""
        if name in _BASIC:
            return _BASIC[name], ""
        scope, _, last = name.rpartition("::")
        if last in self._typedefs:
            return self._typedefs[last]
        if not last[0].isupper():
            raise self._error(f"'{name}' has no counterpart in .msg files", word.line)
        return (f"{scope.split('::')[0]}/{last}" if scope else last), ""

    def _dimension(self) -> str:
        if not self._take("["):
            return ""
        size = self._next("number")
        self._expect("]")
        if self._peek().text == "[":
            raise self._error("an array of arrays has no counterpart", size.line)
        return f"[{size.text}]"

    def _annotations(self) -> dict[str, str]:
        """Defaults and comments among the annotations that come next."""
        found = {}
        while self._take("@"):
            name = self._next("name").text
            values: dict[str, str] = {}
            if self._take("("):
                while not self._take(")"):
                    key = self._next("name").text if self._peek().kind == "name" else ""
                    if not self._take("="):
                        values["value"] = key or self._literal()
                    else:
                        values[key] = self._literal()
                    self._take(",")
            found[name] = values.get("value", "")
            if "text" in values:
                found[name] = _unquoted(values["text"])
        return found

    def _literal(self) -> str:
        """A value as written; texts that follow each other are one."""
        token = self._next()
        if token.kind not in ("text", "number", "name"):
            raise self._error(f"expected a value, got '{token.text}'", token.line)
        text = token.text
        while token.kind == "text" and self._peek().kind == "text":
            text = text[:-1] + self._next().text[1:]
        return text

    def _peek(self) -> _Token:
        return self._tokens[self._at]

    def _next(self, kind: str = "") -> _Token:
        token = self._peek()
        if token.kind == "end" or (kind and token.kind != kind):
            raise self._error(f"expected a {kind or 'value'}, got '{token.text}'", token.line)
        self._at += 1
        return token

    def _take(self, symbol: str) -> bool:
        if self._peek().text != symbol:
            return False
        self._at += 1
        return True

    def _expect(self, symbol: str) -> None:
        if not self._take(symbol):
            token = self._peek()
            raise self._error(f"expected '{symbol}', got '{token.text}'", token.line)

    def _error(self, text: str, line: int) -> InterfaceError:
        return InterfaceError(f"{self._full_name}.idl, line {line}: {text}")


def _unquoted(text: str) -> str:
    return text[1:-1].replace("\\n", "\n").replace('\\"', '"').replace("\\\\", "\\")


def _value(type_: str, default: str) -> str:
    """A default as .msg files have it: lists stand in quotes in IDL."""
    return _unquoted(default) if type_.endswith("]") and default.startswith('"') else default
