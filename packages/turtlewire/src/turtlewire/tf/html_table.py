"""Tables for the display of objects in notebooks.

They have no colours of their own, so they are readable in light and dark notebooks.
"""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from turtlewire.terminal.printable import printable

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["MOST_ROWS", "counted", "html_table", "html_text"]

#: A table of more rows is cut; the caller says so in the caption.
MOST_ROWS = 500
_LONGEST = 120


def counted(count: int, noun: str) -> str:
    """Return a number with its noun: ``1 link``, ``2,000 links``."""
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def html_text(text: str) -> str:
    """Return a name or sentence as HTML on one line: escaped, and cut if it is long.

    Names come from other processes and from files, so they may contain HTML and direction marks.
    """
    cut = text if len(text) <= _LONGEST else text[: _LONGEST - 1] + "…"
    return escape(printable(cut))


def html_table(
    title: str, caption: str, heads: Sequence[str], rows: Sequence[Sequence[str | int]]
) -> str:
    """Return a table that scrolls if it is long.

    Args:
        title: The bold beginning of the caption.
        caption: The rest of the caption.
        heads: The names of the columns.
        rows: The cells; numbers are aligned to the right.
    """
    first = rows[0] if rows else heads
    head = "".join(_cell("th", name, like) for name, like in zip(heads, first, strict=True))
    body = "".join(f"<tr>{''.join(_cell('td', each, each) for each in row)}</tr>" for row in rows)
    return (
        '<div style="max-height:32em;overflow:auto"><table>'
        '<caption style="text-align:left;white-space:nowrap">'
        f"<b>{html_text(title)}</b>{html_text(caption)}</caption>"
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _cell(tag: str, content: str | int, like: str | int) -> str:
    """Return a cell that is aligned like another one of its column."""
    text = f"{content:,}" if isinstance(content, int) else html_text(content)
    side = "right" if isinstance(like, int) else "left"
    return f'<{tag} style="text-align:{side}">{text}</{tag}>'
