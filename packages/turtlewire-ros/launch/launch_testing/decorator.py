"""Marks a class of tests that run after the shutdown."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import unittest

T = TypeVar("T", bound="type[unittest.TestCase]")


def post_shutdown_test() -> Callable[[T], T]:
    """Decorate a ``unittest.TestCase`` whose tests run when all processes have ended."""

    def decorate(test_class: T) -> T:
        test_class.__post_shutdown_test__ = True  # type: ignore[attr-defined]
        return test_class

    return decorate
