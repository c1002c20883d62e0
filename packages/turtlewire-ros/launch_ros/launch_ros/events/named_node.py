"""The action that runs a node, as events and matchers know it."""

from __future__ import annotations

from typing import Protocol

__all__ = ["NamedNode"]


class NamedNode(Protocol):
    """What events know of a ``Node`` or ``LifecycleNode``."""

    @property
    def node_name(self) -> str:
        """Full name of the node."""
