"""Base of entities that can be destroyed."""

from __future__ import annotations

from typing import Protocol


class DestroyableType(Protocol):
    """A publisher, a subscription, a timer … or the handle of one."""

    def __enter__(self) -> object: ...

    def __exit__(self, t: object, v: object, tb: object, /) -> None: ...
