"""Decides if the end of a process waits for acknowledgements of its last messages.

Cyclone waits for up to a second, and for a tenth to three tenths as a rule. A program that has
received the answer to its request need not wait.
"""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["leaving_at_once", "lingers"]

_leaving = 0


@contextlib.contextmanager
def leaving_at_once() -> Iterator[None]:
    """Make the process leave domains that it joins within this context without waiting."""
    global _leaving  # noqa: PLW0603  domains belong to the process
    _leaving += 1
    try:
        yield
    finally:
        _leaving -= 1


def lingers() -> bool:
    """Return True if a domain that is joined now is left only after waiting."""
    return not _leaving
