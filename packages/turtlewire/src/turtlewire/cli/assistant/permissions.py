"""The topics and services that an assistant may use; the errors that it reads."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Permissions", "RefusedCallError", "full_name"]


class RefusedCallError(Exception):
    """A call of a tool that cannot be done; the text says why, and what can be done instead."""


def full_name(name: str) -> str:
    """Return the name of a topic or service with the slash that an assistant may have left out."""
    return name if name.startswith("/") else f"/{name}"


class Permissions:
    """Names of topics and services; one that ends in ``*`` stands for all that begin like it.

    Args:
        patterns: The values of ``--allow``.

    Raises:
        ValueError: A pattern is empty, or has a ``*`` before its end.
    """

    def __init__(self, patterns: Sequence[str] = ()) -> None:
        for pattern in patterns:
            if not pattern or "*" in pattern[:-1]:
                raise ValueError(
                    f"{pattern!r} is not the name of a topic or service, such as /turtle1/cmd_vel, "
                    "or the beginning of names with * at its end, such as '/turtle1/*'"
                )
        self._patterns = ["*" if each == "*" else full_name(each) for each in patterns]

    def __bool__(self) -> bool:
        return bool(self._patterns)

    def __str__(self) -> str:
        return ", ".join(self._patterns) or "nothing"

    def allow(self, name: str) -> bool:
        """Return True if a topic or service may be used."""
        return any(
            name.startswith(pattern[:-1]) if pattern.endswith("*") else name == pattern
            for pattern in self._patterns
        )

    def require(self, name: str, action: str) -> None:
        """Make sure that a topic or service may be used.

        Args:
            name: Its full name.
            action: What was asked for, such as ``publish to``.

        Raises:
            RefusedCallError: The name is not allowed.
        """
        if not self.allow(name):
            raise RefusedCallError(
                f"Refused to {action} {name}. Allowed: {self}. Only the person who starts this "
                f"server can allow more: turtlewire mcp --allow {shlex.quote(name)}"
            )
