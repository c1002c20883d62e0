"""Translates .idl files of interfaces into the text of .msg, .srv and .action files.

Constructs that .msg files do not have raise an error with the line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from turtlewire.errors import InterfaceError
from turtlewire.msg.idl_reader import BASIC_TYPES, IdlReader, IdlStructure, unescaped
from turtlewire.msg.types import AbstractNestedType, AbstractType, type_in_msg_file

if TYPE_CHECKING:
    from turtlewire.msg.idl_reader import Notes

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
    reader = _Reader(f"{full_name}.idl", text)
    reader.read()
    structures = {each.name: each for each in reader.structures}
    parts = []
    for part in (f"{name}{suffix}" for suffix in _PARTS[kind]):
        if part not in structures:
            raise InterfaceError(f"{full_name}.idl has no struct {part}")
        constants = [
            f"{type_in_msg_file(each.type)} {each.name} = {each.value}\n"
            for each in reader.constants
            if each.modules[-1:] in ((f"{part}_Constants",), (part,))
        ]
        comments, fields = _comments(structures[part].notes), _fields(structures[part])
        parts.append("".join([*comments, *constants, *fields]))
    return "---\n".join(parts)


class _Reader(IdlReader):
    """Reads one file; values stay as they are written."""

    basic_types = BASIC_TYPES
    refusal = "has no counterpart in .msg files"

    def sequence(self, inner: AbstractType, size: int | None, line: int) -> AbstractType:
        if isinstance(inner, AbstractNestedType):
            raise self.error("a sequence of sequences has no counterpart", line)
        return super().sequence(inner, size, line)

    def named_type(self, name: str, line: int) -> AbstractType:
        last = name.rpartition("::")[2]
        if last in self.typedefs:
            return self.typedefs[last]
        if not last[0].isupper():
            raise self.error(f"'{name}' {self.refusal}", line)
        return super().named_type(name, line)

    def dimension(self, type_: AbstractType) -> AbstractType:
        line = self.peek().line
        found = super().dimension(type_)
        if found is not type_ and self.peek().text == "[":
            raise self.error("an array of arrays has no counterpart", line)
        return found

    def word(self, text: str) -> str:
        return text

    def literal(self) -> str:
        token = self.next()
        if token.kind not in ("text", "number", "name"):
            raise self.error(f"expected a value, got '{token.text}'", token.line)
        text = token.text
        while token.kind == "text" and self.peek().kind == "text":
            text = text[:-1] + self.next().text[1:]
        return text


def _comments(notes: Notes) -> list[str]:
    texts = [value["text"] for name, value in notes if name == "verbatim" and "text" in value]
    return [f"# {line}\n" for text in texts[-1:] for line in unescaped(text[1:-1]).splitlines()]


def _fields(structure: IdlStructure) -> list[str]:
    lines = []
    for type_, name, notes in structure.members:
        values = dict(notes).get("default") or ""
        default = values.get("value", "") if isinstance(values, dict) else values
        if isinstance(type_, AbstractNestedType) and default.startswith('"'):
            default = unescaped(default[1:-1])  # IDL has lists in quotes
        if name != _DUMMY:
            lines.append(f"{type_in_msg_file(type_)} {name} {default}".rstrip() + "\n")
    return lines
