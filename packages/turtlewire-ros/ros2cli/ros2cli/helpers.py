"""Small functions that extensions of ``ros2`` share."""

from __future__ import annotations

import functools
import os
import sys
import time
from typing import TYPE_CHECKING, Any

from ros2cli.values import unsigned_int as _unsigned_int

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = [
    "before_invocation",
    "bind",
    "collect_stdin",
    "get_ros_domain_id",
    "pretty_print_call",
    "unsigned_int",
    "wait_for",
]


def get_ros_domain_id() -> int:
    """Number of the domain, from ``ROS_DOMAIN_ID``; 0 by default."""
    return int(os.environ.get("ROS_DOMAIN_ID") or 0)


def before_invocation(func: Callable[..., Any], hook: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that calls ``hook`` with the same arguments before ``func``."""

    @functools.wraps(func)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        hook(*args, **kwargs)
        return func(*args, **kwargs)

    return wrapper


def bind(func: Callable[..., Any], *args: Any, **kwargs: Any) -> Callable[..., Any]:
    """`functools.partial` that keeps name and documentation of ``func``."""
    return functools.update_wrapper(functools.partial(func, *args, **kwargs), func)


def pretty_print_call(func: Callable[..., Any], *args: Any, **kwargs: Any) -> None:
    """Print a call as it would be written."""
    words = [*map(repr, args), *(f"{name}={value!r}" for name, value in kwargs.items())]
    print(f"{func.__name__}({', '.join(words)})")


def collect_stdin() -> str:
    """Return all of stdin, read line by line until its end."""
    return "".join(sys.stdin)


def unsigned_int(string: str) -> int:
    """Return a whole number from zero, for argparse.

    Raises:
        ArgumentTypeError: The number is negative.
    """
    return _unsigned_int(string)


def wait_for(predicate: Callable[[], bool], timeout: float, period: float = 0.1) -> bool:
    """Ask a predicate again and again; for conditions that nothing announces.

    Args:
        predicate: The condition.
        timeout: Seconds until the last question.
        period: Seconds between questions.

    Returns:
        Whether it was true in time.
    """
    deadline = time.monotonic() + timeout
    while not predicate():
        rest = deadline - time.monotonic()
        if rest <= 0:
            return predicate()
        time.sleep(min(period, rest))
    return True
