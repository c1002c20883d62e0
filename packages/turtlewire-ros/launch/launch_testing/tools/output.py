"""Patterns of a program's expected output."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable
from typing import Any

from launch_testing.tools.text import build_line_match, build_text_match, normalize_lineseps

_ESCAPE_SEQUENCE = re.compile(r"\x1b(?:[@-Z\\-_]|\[[0-?]*[ -/]*[@-~])")


def get_default_filtered_prefixes() -> list[str]:
    """Return the beginnings of lines that output filters remove by default."""
    return ["pid", "rc"]


def get_default_filtered_patterns() -> list[str]:
    """Return the patterns of lines that output filters remove by default."""
    return []


def basic_output_filter(
    filtered_prefixes: Iterable[str] | None = None,
    filtered_patterns: Iterable[str] | None = None,
) -> Callable[[str], str]:
    """Return a function that removes lines from a text.

    Args:
        filtered_prefixes: Beginnings of the lines that are removed.
        filtered_patterns: Patterns of :mod:`re` for such lines.
    """
    prefixes = tuple(
        get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes
    )
    patterns = [
        re.compile(pattern)
        for pattern in (
            get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns
        )
    ]

    def remains(line: str) -> bool:
        return not line.startswith(prefixes) and not any(each.match(line) for each in patterns)

    def filtered(output: str) -> str:
        lines = [line for line in output.splitlines() if remains(line)]
        # Keep the line end of the last line.
        return "\n".join(lines) + ("\n" if lines and output.endswith("\n") else "")

    return filtered


def expect_output(
    text: str | None = None,
    *,
    lines: list[str] | None = None,
    expected_text: Any = None,
    expected_lines: Any = None,
    strip_ansi_escape_sequences: bool = True,
    strict: bool = False,
) -> bool:
    """Return True if a text, or lines, are as expected.

    Args:
        text: The text; without it ``lines``.
        lines: The lines; ``text`` is split if they are not given.
        expected_text: As for :func:`launch_testing.tools.text.build_text_match`.
        expected_lines: As for :func:`launch_testing.tools.text.build_line_match`.
        strip_ansi_escape_sequences: Whether colours and other sequences are removed before.
        strict: Whether there must be nothing else.

    Raises:
        ValueError: Text and lines are both given or both missing, or so are the expected ones.
    """
    if (text is None) == (lines is None):
        raise ValueError("Either text or lines must be given, and not both")
    if (expected_text is None) == (expected_lines is None):
        raise ValueError("Either expected_text or expected_lines must be given, and not both")
    actual = "\n".join(lines) if text is None else text  # type: ignore[arg-type]
    actual = normalize_lineseps(actual)
    if strip_ansi_escape_sequences:
        actual = _ESCAPE_SEQUENCE.sub("", actual)
    if expected_lines is not None:
        match = build_line_match(expected_lines, strict=strict)
        return bool(_found(match(actual.splitlines())))
    return bool(_found(build_text_match(expected_text, strict=strict)(actual)))


def _found(result: Any) -> bool:
    """Return True if a match function succeeded: ours return a span, others any true value."""
    return isinstance(result, tuple) or bool(result)


def expected_text_matches(
    text: str, expected: Any, output_filter: Callable[[str], str] | None, *, strip: bool
) -> bool:
    """Return True if output has what an assertion expects.

    Args:
        text: The output.
        expected: As for :func:`expect_output`; a list of texts or patterns are lines.
        output_filter: Changes the text before, or None.
        strip: Whether escape sequences are removed before.
    """
    if strip:
        text = _ESCAPE_SEQUENCE.sub("", text)
    if output_filter is not None:
        text = output_filter(text)
    kind = "expected_lines" if isinstance(expected, (list, tuple)) else "expected_text"
    return expect_output(text, **{kind: expected}, strip_ansi_escape_sequences=False)


def expected_output_from_file(
    path: str | os.PathLike[str], encoding: str | None = None
) -> list[str] | list[re.Pattern[str]]:
    """Read a program's expected output from a file.

    Args:
        path: Path without extension. ``PATH.txt`` holds lines, ``PATH.regex`` a pattern in each
            line.
        encoding: The file's encoding.

    Raises:
        RuntimeError: Neither file exists.
    """
    base = os.fspath(path)
    if os.path.isfile(f"{base}.txt"):
        return _lines(f"{base}.txt", encoding)
    if os.path.isfile(f"{base}.regex"):
        return [re.compile(line) for line in _lines(f"{base}.regex", encoding)]
    raise RuntimeError(f"could not find output check file: neither '{base}.txt' nor '{base}.regex'")


def _lines(path: str, encoding: str | None) -> list[str]:
    with open(path, encoding=encoding) as file:
        return file.read().splitlines()
