"""Filters of the middleware's output."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable

from ament_index_python.resources import get_resource
from launch_testing.tools import output


def get_rmw_output_filter(rmw_implementation: str, filter_type: str) -> list[str]:
    """Return the lines that a middleware is known to write.

    Args:
        rmw_implementation: Its name.
        filter_type: ``prefixes`` or ``patterns``.

    Returns:
        What ament's index holds of it; an empty list if that is nothing.
    """
    try:
        text, _ = get_resource(f"rmw_output_{filter_type}", rmw_implementation)
    except LookupError:
        return []
    return [line for line in text.splitlines() if line]


def basic_output_filter(
    filtered_prefixes: Iterable[str] | None = None,
    filtered_patterns: Iterable[str] | None = None,
    filtered_rmw_implementation: str | None = None,
) -> Callable[[str], str]:
    """Return a function that removes lines from a text, the middleware's included.

    Args:
        filtered_prefixes: As for :func:`launch_testing.tools.basic_output_filter`.
        filtered_patterns: Likewise.
        filtered_rmw_implementation: The middleware; by default ``RMW_IMPLEMENTATION``.
    """
    # Copies of the arguments, because the middleware's are added below.
    prefixes = (
        output.get_default_filtered_prefixes()
        if filtered_prefixes is None
        else list(filtered_prefixes)
    )
    patterns = (
        output.get_default_filtered_patterns()
        if filtered_patterns is None
        else list(filtered_patterns)
    )
    rmw = filtered_rmw_implementation or os.environ.get("RMW_IMPLEMENTATION")
    if rmw:
        prefixes += get_rmw_output_filter(rmw, "prefixes")
        patterns += get_rmw_output_filter(rmw, "patterns")
    return output.basic_output_filter(prefixes, patterns)
