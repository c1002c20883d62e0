"""Markers of functions that create launch descriptions, and of tests."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable
from typing import Any, TypeVar

F = TypeVar("F", bound="Callable[..., Any]")


def mark(function: Callable[..., Any], name: str, value: object) -> None:
    """Add a mark to a function that makes a launch description."""
    vars(function).setdefault("__markers__", {})[name] = value


def keep_alive(test_description: F) -> F:
    """Keep the launch running until the tests end, even if all its processes have ended."""
    mark(test_description, "keep_alive", True)
    return test_description


def retry_on_failure(*, times: int, delay: float | None = None) -> Callable[[F], F]:
    """Decorate a test method that is repeated while it fails.

    Args:
        times: How often it runs at most. Only the last ``AssertionError`` is a failure.
        delay: Seconds between two runs.

    Raises:
        ValueError: ``times`` is not positive.
    """
    if times < 1:
        raise ValueError(f"times must be at least 1, not {times}")

    def decorate(function: F) -> F:
        @functools.wraps(function)
        def repeated(*args: Any, **kwargs: Any) -> Any:
            for _ in range(times - 1):
                try:
                    return function(*args, **kwargs)
                except AssertionError:  # noqa: PERF203  each run is a test
                    if delay is not None:
                        time.sleep(delay)
            return function(*args, **kwargs)

        return repeated  # type: ignore[return-value]

    return decorate
