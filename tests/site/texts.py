"""The texts that the sources print, for the page that lists errors by their texts."""

from __future__ import annotations

import ast
import re
from functools import cache

from tests.places import PACKAGES

PLACEHOLDER = re.compile(r"\{[^{}]*\}|%[sd]")


@cache
def sources() -> dict[str, list[str]]:
    """The texts of each Python file; `…` stands for what is filled in."""
    return {
        str(path): _texts_of(ast.parse(path.read_text(encoding="utf-8")))
        for folder in PACKAGES
        for path in folder.rglob("*.py")
    }


def _texts_of(tree: ast.AST) -> list[str]:
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            parts = [part.value if isinstance(part, ast.Constant) else "…" for part in node.values]
            found.append("".join(map(str, parts)))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            found.append(PLACEHOLDER.sub("…", node.value))
    return found


def is_printed(text: str) -> bool:
    """Whether one source file has all parts of a text in its own texts."""
    parts = [part.strip(" \n") for part in text.split("…") if len(part.strip(" '\"[]:.,\n")) > 1]
    assert parts, text
    return any(
        all(any(part in own for own in texts) for part in parts) for texts in sources().values()
    )
