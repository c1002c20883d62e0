"""The index of modules in ARCHITECTURE.md, written from the tables in the packages' docstrings."""

from __future__ import annotations

import ast
import re
import textwrap
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from architecture import House

BEGIN, END = "<!-- modules: written by scripts/architecture -->\n", "<!-- end of modules -->\n"
_ROW = re.compile(r"^(`\w+`(?:, `\w+`)*)  +(\S.*)$", re.MULTILINE)


def rows(docstring: str) -> list[tuple[str, str]]:
    """Return the rows of a package's table: modules in backticks, and what they hold."""
    return _ROW.findall(docstring)


def with_index(text: str, root: Path, house: House) -> str:
    """Return the text of ARCHITECTURE.md with the index between its marks."""
    before, mark, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not mark or not end:
        return text
    return before + mark + "\n" + "\n\n".join(_packages(root, house)) + "\n\n" + end + after


def _packages(root: Path, house: House) -> Iterator[str]:
    for name, path in house.paths.items():
        table = rows(ast.get_docstring(house.trees[name]) or "")
        if path.name == "__init__.py" and table:
            # Double backticks are reST; Markdown needs single ones.
            items = [f"{modules}: {holds.replace('``', '`')}" for modules, holds in table]
            folder = path.parent.relative_to(root).as_posix()
            text = f"- **{folder}** — {' · '.join(items)}"
            yield textwrap.fill(
                text, 100, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
            )
