"""The timeout for a launch to reach its ``ReadyToTest``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from launch_testing.markers import mark

if TYPE_CHECKING:
    from typing import Any

F = TypeVar("F", bound="Callable[..., Any]")


def ready_to_test_action_timeout(timeout: float) -> Callable[[F], F]:
    """Decorate ``generate_test_description`` with the seconds until it must be ready.

    The default is 15 s.
    """

    def decorate(function: F) -> F:
        mark(function, "timeout", timeout)
        return function

    return decorate
