"""Mappings that are remembered and put back."""

from __future__ import annotations

from collections.abc import Mapping, MutableMapping
from typing import Generic, TypeVar

V = TypeVar("V")


class Scopes(Generic[V]):
    """A stack of copies of one mapping, for changes that end with a scope.

    Args:
        values: The mapping, which is changed in place.
        kind: Names it in errors.
    """

    def __init__(self, values: MutableMapping[str, V], kind: str) -> None:
        self._values = values
        self._kind = kind
        self._copies: list[dict[str, V]] = []

    @property
    def depth(self) -> int:
        """The number of scopes that have begun and not ended."""
        return len(self._copies)

    def push(self) -> None:
        """Remember the values."""
        self._copies.append(dict(self._values))

    def pop(self) -> None:
        """Put the values back that were remembered last.

        Raises:
            RuntimeError: No scope was pushed.
        """
        if not self._copies:
            raise RuntimeError(f"{self._kind} stack unexpectedly empty")
        self.replace(self._copies.pop())

    def replace(self, values: Mapping[str, V]) -> None:
        """Make the mapping equal to ``values``."""
        # In place, because `os.environ` cannot be replaced.
        for name in set(self._values) - set(values):
            del self._values[name]
        self._values.update(values)
