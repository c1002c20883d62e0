"""The action that runs a node, as events and matchers know it."""

from __future__ import annotations

from typing import Protocol

__all__ = ["NamedNode"]


class NamedNode(Protocol):
    """The action that runs a node; ``Node`` and ``LifecycleNode`` are ones."""

    @property
    def node_name(self) -> str:
        """Full name of the node."""
