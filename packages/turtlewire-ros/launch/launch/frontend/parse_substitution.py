r"""Reads text with substitutions, ``hello $(var name)``, of launch files in XML and YAML.

``$(name argument ...)``: arguments are separated by blanks, quoted by ``'`` or ``"`` when they
contain some, and may hold further substitutions. ``\\$``, ``\\'``, ``\\"`` and ``\\\\`` stand for
the character alone.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import instantiate_substitution
from launch.substitution import TextSubstitution

if TYPE_CHECKING:
    from launch.substitution import Substitution

_ESCAPABLE = "$'\"\\"


def parse_substitution(string_value: str) -> list[Substitution]:
    """Return the substitutions that a text consists of; plain stretches are text substitutions.

    Raises:
        SyntaxError: A substitution is not closed.
        RuntimeError: No substitution has this name.
    """
    if not string_value:
        return [TextSubstitution(text="")]
    reader = _Reader(string_value)
    parts = reader.read_until("")
    reader.expect_end()
    return parts


def parse_if_substitutions(value: Any) -> Any:
    """Convert text, and text in lists, to substitutions; return other values unchanged."""
    if isinstance(value, str):
        return parse_substitution(value)
    if isinstance(value, list):
        return [parse_if_substitutions(item) for item in value]
    return value


def replace_escaped_characters(data: str) -> str:
    r"""Unescape a text without substitutions: ``\$``, ``\'``, ``\"`` and ``\\``."""
    return re.sub(r"\\([$'\"\\])", r"\1", data)


def get_grammar_path() -> str:
    """Return the path of the grammar for lark that describes the texts of `parse_substitution`."""
    return os.path.join(os.path.dirname(__file__), "grammar.lark")


class ExtractSubstitution:
    """Turns the tree that lark makes with the grammar of `get_grammar_path` into substitutions.

    It works as a ``lark.Transformer`` does: a method gets the results for the children of each
    node of its name. `parse_substitution` reads the same texts without lark.

    Args:
        visit_tokens: Accepted as by lark; tokens stay text.
    """

    def __init__(self, visit_tokens: bool = True) -> None:
        self.visit_tokens = visit_tokens

    def transform(self, tree: Any) -> Any:
        """Return the result for a tree: a list of substitutions for a whole text."""
        results = [
            self.transform(child) if hasattr(child, "children") else child
            for child in tree.children
        ]
        return getattr(self, tree.data)(results)

    def template(self, fragments: list[Substitution]) -> list[Substitution]:
        """Return the substitutions of a text."""
        return fragments or [TextSubstitution(text="")]

    def fragment(self, content: list[str]) -> Substitution:
        """Return plain text as a substitution."""
        return TextSubstitution(text=replace_escaped_characters("".join(content)))

    def substitution(self, args: list[Any]) -> Substitution:
        """Return the substitution of a name and its arguments."""
        name, arguments = args[0], args[1] if len(args) > 1 else []
        return instantiate_substitution(str(name), arguments)

    def arguments(self, values: list[list[Substitution]]) -> list[list[Substitution]]:
        """Return the arguments of a substitution."""
        return values

    def value(self, parts: list[Any]) -> list[Substitution]:
        """Return the substitutions of an argument; a quoted one is a list already."""
        return parts[0] if isinstance(parts[0], list) else parts

    def single_quoted_value(self, parts: list[Substitution]) -> list[Substitution]:
        """Return the substitutions between quotes."""
        return self.template(parts)

    double_quoted_value = single_quoted_value
    part = single_quoted_part = double_quoted_part = fragment
    single_quoted_fragment = double_quoted_fragment = fragment
    single_quoted_template = double_quoted_template = template
    single_quoted_arguments = double_quoted_arguments = arguments
    single_quoted_substitution = double_quoted_substitution = substitution


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0

    def read_until(self, stops: str) -> list[Substitution]:
        """Read up to one of the characters, which is not consumed."""
        parts: list[Substitution] = []
        plain: list[str] = []
        while self._at < len(self._text) and self._text[self._at] not in stops:
            if self._text.startswith("$(", self._at):
                if plain:
                    parts.append(TextSubstitution(text="".join(plain)))
                    plain = []
                parts.append(self._substitution())
            else:
                plain.append(self._character())
        if plain:
            parts.append(TextSubstitution(text="".join(plain)))
        return parts

    def expect_end(self) -> None:
        if self._at != len(self._text):
            raise SyntaxError(
                f"unexpected '{self._text[self._at]}' at position {self._at} of '{self._text}'"
            )

    def _character(self) -> str:
        character = self._text[self._at]
        # The empty string is in every string, so the end of the text needs its own check.
        if (
            character == "\\"
            and self._text[self._at + 1 : self._at + 2] in _ESCAPABLE
            and self._at + 1 < len(self._text)
        ):
            self._at += 1
            character = self._text[self._at]
        self._at += 1
        return character

    def _substitution(self) -> Substitution:
        start = self._at
        self._at += 2
        self._skip_blanks()
        name_start = self._at
        while self._at < len(self._text) and (
            self._text[self._at].isalnum() or self._text[self._at] in "-_"
        ):
            self._at += 1
        name = self._text[name_start : self._at]
        arguments: list[list[Substitution]] = []
        while True:
            self._skip_blanks()
            if self._at >= len(self._text):
                raise SyntaxError(f"the substitution '{self._text[start:]}' is not closed by ')'")
            if self._text[self._at] == ")":
                self._at += 1
                return instantiate_substitution(name, arguments)
            arguments.append(self._argument())

    def _argument(self) -> list[Substitution]:
        quote = self._text[self._at]
        if quote not in "'\"":
            return self.read_until(" \t\r\n)")
        self._at += 1
        parts = self.read_until(quote)
        if self._at >= len(self._text):
            raise SyntaxError(f"the quote {quote} in '{self._text}' is not closed")
        self._at += 1
        # Between quotes, an argument may be empty.
        return parts or [TextSubstitution(text="")]

    def _skip_blanks(self) -> None:
        while self._at < len(self._text) and self._text[self._at].isspace():
            self._at += 1
