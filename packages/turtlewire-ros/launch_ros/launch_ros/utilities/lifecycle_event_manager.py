"""ROS 2's module of `LifecycleEventManager`.

The manager makes events of the transitions of a managed node, and transitions of ``ChangeState``
events. `LifecycleNode` and `ComposableLifecycleNode` have one; an action of another package that
starts a managed node makes its own:

    manager = LifecycleEventManager(self)
    manager.setup_lifecycle_manager(context)
"""

from __future__ import annotations

from typing import Any

__all__ = ["LifecycleEventManager"]  # noqa: F822  `__getattr__` gives it


def __getattr__(name: str) -> Any:
    """Load the class on first use: its module imports this package."""
    if name != "LifecycleEventManager":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return import_module("launch_ros._node.lifecycle").LifecycleEventManager
