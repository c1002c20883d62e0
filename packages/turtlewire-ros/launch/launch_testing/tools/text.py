"""Functions that find expected text or lines."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

_Span = tuple[int, int]


def normalize_lineseps(lines: str) -> str:
    r"""Return the text with ``\n`` at the end of each line."""
    return re.sub(r"\r\n|\n\r|\r", "\n", lines)


def build_text_match(expected_text: Any, *, strict: bool = False) -> Callable[..., _Span | None]:
    """Return a function that searches a text, from a position on, and returns the span.

    Args:
        expected_text: A text, a pattern of :mod:`re`, an iterable of them, which come in that
            order, or a function, which is returned as it is.
        strict: Whether nothing else may be in the text.

    Raises:
        ValueError: The argument has another type.
    """
    if callable(expected_text):
        found: Callable[..., _Span | None] = expected_text
        return found
    if isinstance(expected_text, (str, re.Pattern)):
        pattern = _pattern(expected_text)
        # Positions, not slices: look-behinds and `^` see the whole text.
        find = pattern.fullmatch if strict else pattern.search

        def match_one(actual_text: str, start: int = 0) -> _Span | None:
            match = find(actual_text, start)
            return None if match is None else match.span()

        return match_one
    if isinstance(expected_text, Iterable):
        return _sequence_match([build_text_match(each) for each in expected_text], strict)
    raise ValueError(
        f"expected a string, a pattern, a list of them or a function, got {expected_text!r}"
    )


def build_line_match(expected_lines: Any, *, strict: bool = False) -> Callable[..., _Span | None]:
    """Return a function that searches lines, from an index on, and returns the span.

    Args:
        expected_lines: A line or a pattern for one, an iterable of them, which come in that order
            (with others between them), or a function, which is returned as it is.
        strict: Whether the lines must be exactly these.

    Raises:
        ValueError: The argument has another type.
    """
    if callable(expected_lines):
        found: Callable[..., _Span | None] = expected_lines
        return found
    if isinstance(expected_lines, (str, re.Pattern)):
        expected_lines = [expected_lines]
    if not isinstance(expected_lines, Iterable):
        raise ValueError(  # noqa: TRY004  as above, where it is ROS 2's class
            f"expected a line, a pattern, a list of them or a function, got {expected_lines!r}"
        )
    fits = [_line_fits(each, strict) for each in expected_lines]

    def match(actual_lines: list[str], start: int = 0) -> _Span | None:
        if strict and len(actual_lines) - start != len(fits):
            return None
        position, first = start, None
        for fit in fits:
            hits = (n for n in range(position, len(actual_lines)) if fit(actual_lines[n]))
            at = next(hits, None)
            if at is None or (strict and at != position):
                return None
            first = at if first is None else first
            position = at + 1
        return (start if first is None else first), position

    return match


def _pattern(expected: str | re.Pattern[str]) -> re.Pattern[str]:
    return re.compile(re.escape(expected)) if isinstance(expected, str) else expected


def _line_fits(expected: Any, strict: bool) -> Callable[[str], bool]:
    match = build_text_match(expected, strict=strict)
    return lambda line: match(line) is not None


def _sequence_match(
    matches: Iterable[Callable[..., _Span | None]], strict: bool
) -> Callable[..., _Span | None]:
    parts = list(matches)

    def match(actual_text: str, start: int = 0) -> _Span | None:
        position, first = start, None
        for part in parts:
            span = part(actual_text, position)
            if span is None or (strict and span[0] != position):
                return None
            first = span[0] if first is None else first
            position = span[1]
        if strict and position != len(actual_text):
            return None
        return (start if first is None else first), position

    return match
