"""Translates .idl files of interfaces into the text of .msg, .srv and .action files.

The part of IDL 4.2 is read that ROS 2's interfaces use: modules, structures, constants, typedefs of
arrays, annotations with defaults and comments. Whatever else IDL has (unions, enums, maps) cannot
be said in a .msg file, and is refused with its line.
"""

from __future__ import annotations

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl_tokens import IdlTokens

__all__ = ["idl_to_text"]

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


class _Reader(IdlTokens):
    """Reads one file; the lines for .msg files are in its attributes, by structure."""

    def __init__(self, full_name: str, text: str) -> None:
        super().__init__(f"{full_name}.idl", text)
        self._typedefs: dict[str, tuple[str, str]] = {}
        self.structures: dict[str, list[str]] = {}
        self.constants: dict[str, list[str]] = {}
        self.comments: dict[str, list[str]] = {}

    def read(self) -> None:
        """Read the whole file."""
        while self.peek().kind != "end":
            self._definition("")

    def _definition(self, module: str) -> None:
        notes = self._annotations()
        word = self.next("name")
        if word.text == "module":
            name = self.next("name").text
            self.expect("{")
            while not self.take("}"):
                self._definition(name)
        elif word.text == "struct":
            self._structure(notes)
        elif word.text == "const":
            self._constant(module)
        elif word.text == "typedef":
            type_, suffix = self._type()
            name = self.next("name").text
            self._typedefs[name] = (type_, suffix + self._dimension())
        else:
            raise self.error(f"'{word.text}' has no counterpart in .msg files", word.line)
        self.expect(";")

    def _structure(self, notes: dict[str, str]) -> None:
        name = self.next("name").text
        self.comments[name] = [f"# {line}" for line in notes.get("verbatim", "").splitlines()]
        fields = self.structures.setdefault(name, [])
        self.expect("{")
        while not self.take("}"):
            default = self._annotations().get("default", "")
            type_, suffix = self._type()
            while True:
                field = self.next("name").text
                whole = type_ + suffix + self._dimension()
                if field != _DUMMY:
                    fields.append(f"{whole} {field} {_value(whole, default)}".rstrip())
                if not self.take(","):
                    break
            self.expect(";")

    def _constant(self, module: str) -> None:
        type_, _ = self._type()
        name = self.next("name").text
        self.expect("=")
        lines = self.constants.setdefault(module.removesuffix("_Constants"), [])
        lines.append(f"{type_} {name} = {self._literal()}")

    def _type(self) -> tuple[str, str]:
        """Return a type, and the brackets that follow it in a .msg file."""
        word = self.next("name")
        name = word.text
        while name in ("unsigned", "long", "unsigned long") and self.peek().text in (
            "short",
            "long",
        ):
            name = f"{name} {self.next('name').text}"
        if name == "sequence":
            self.expect("<")
            inner, suffix = self._type()
            size = f"<={self.next('number').text}" if self.take(",") else ""
            self.expect(">")
            if suffix:
                raise self.error("a sequence of sequences has no counterpart", word.line)
            return inner, f"[{size}]"
        if name in ("string", "wstring"):
            if not self.take("<"):
                return name, ""
            size = self.next("number").text
            self.expect(">")
            return f"{name}<={size}", ""
        if name in _BASIC:
            return _BASIC[name], ""
        scope, _, last = name.rpartition("::")
        if last in self._typedefs:
            return self._typedefs[last]
        if not last[0].isupper():
            raise self.error(f"'{name}' has no counterpart in .msg files", word.line)
        return (f"{scope.split('::')[0]}/{last}" if scope else last), ""

    def _dimension(self) -> str:
        if not self.take("["):
            return ""
        size = self.next("number")
        self.expect("]")
        if self.peek().text == "[":
            raise self.error("an array of arrays has no counterpart", size.line)
        return f"[{size.text}]"

    def _annotations(self) -> dict[str, str]:
        """Defaults and comments among the annotations that come next."""
        found = {}
        while self.take("@"):
            name = self.next("name").text
            values: dict[str, str] = {}
            if self.take("("):
                while not self.take(")"):
                    key = self.next("name").text if self.peek().kind == "name" else ""
                    if not self.take("="):
                        values["value"] = key or self._literal()
                    else:
                        values[key] = self._literal()
                    self.take(",")
            found[name] = values.get("value", "")
            if "text" in values:
                found[name] = _unquoted(values["text"])
        return found

    def _literal(self) -> str:
        """Return a value as written; texts that follow each other are one."""
        token = self.next()
        if token.kind not in ("text", "number", "name"):
            raise self.error(f"expected a value, got '{token.text}'", token.line)
        text = token.text
        while token.kind == "text" and self.peek().kind == "text":
            text = text[:-1] + self.next().text[1:]
        return text


def _unquoted(text: str) -> str:
    return text[1:-1].replace("\\n", "\n").replace('\\"', '"').replace("\\\\", "\\")


def _value(type_: str, default: str) -> str:
    """Return a default as .msg files have it: lists stand in quotes in IDL."""
    return _unquoted(default) if type_.endswith("]") and default.startswith('"') else default
