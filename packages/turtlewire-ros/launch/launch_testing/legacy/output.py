"""Tests and filters of the output of processes, for `LaunchTestService.add_output_test`."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable

from ament_index_python.resources import get_resource
from launch_testing.tools.output import (
    basic_output_filter,
    get_default_filtered_patterns,
    get_default_filtered_prefixes,
)

__all__ = [
    "create_output_lines_filter",
    "create_output_lines_test",
    "create_output_regex_test",
    "create_output_test_from_file",
    "get_default_filtered_patterns",
    "get_default_filtered_prefixes",
    "get_rmw_output_filter",
]


def get_rmw_output_filter(rmw_implementation: str, filter_type: str) -> list[str]:
    """Return the ``prefixes`` or ``patterns`` of lines that a middleware is known to write."""
    try:
        text, _ = get_resource(f"rmw_output_{filter_type}", rmw_implementation)
    except LookupError:
        return []
    return text.splitlines()


def create_output_lines_filter(
    filtered_prefixes: Iterable[str] | None = None,
    filtered_patterns: Iterable[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Callable[[str], str]:
    """Return a function that removes lines from a text.

    Args:
        filtered_prefixes: Beginnings of the lines; by default ``pid`` and ``rc``.
        filtered_patterns: Patterns of the lines.
        filtered_rmw_implementation: A middleware whose lines are also removed.
    """
    prefixes = list(
        get_default_filtered_prefixes() if filtered_prefixes is None else filtered_prefixes
    )
    patterns = list(
        get_default_filtered_patterns() if filtered_patterns is None else filtered_patterns
    )
    if filtered_rmw_implementation:
        prefixes += get_rmw_output_filter(filtered_rmw_implementation, "prefixes")
        patterns += get_rmw_output_filter(filtered_rmw_implementation, "patterns")
    return basic_output_filter(prefixes, patterns)


def create_output_lines_test(expected_lines: list[str]) -> Callable[[str], bool]:
    """Return a test that a text has these lines, one after the other."""
    count = len(expected_lines)

    def has_lines(output: str) -> bool:
        lines = output.splitlines()
        return any(
            lines[first : first + count] == expected_lines for first in range(len(lines) or 1)
        )

    return has_lines


def create_output_regex_test(expected_patterns: Iterable[str]) -> Callable[[str], bool]:
    """Return a test that each pattern is found in a text."""
    patterns = [re.compile(pattern, re.MULTILINE) for pattern in expected_patterns]
    return lambda output: all(pattern.search(output) for pattern in patterns)


def create_output_test_from_file(output_file: str) -> Callable[[str], bool]:
    """Return the test of a file: of the lines of FILE.txt, or the patterns of FILE.regex.

    Raises:
        RuntimeError: Neither file exists.
    """
    for ending, create in (
        (".txt", create_output_lines_test),
        (".regex", create_output_regex_test),
    ):
        if os.path.isfile(output_file + ending):
            with open(output_file + ending, encoding="utf-8") as file:
                return create(file.read().splitlines())
    raise RuntimeError(f"could not find output check file: {output_file}")
