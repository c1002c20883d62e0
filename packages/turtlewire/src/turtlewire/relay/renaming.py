"""Converts names between the two ends of a relay."""

from __future__ import annotations

from turtlewire.tf.listener import STATIC_TOPIC, TOPIC

__all__ = ["Renaming"]

_TRANSFORMS = {TOPIC, STATIC_TOPIC}


class Renaming:
    """Puts names into a namespace on the way there, and takes them out on the way back.

    Args:
        namespace: The namespace at the far end, such as ``/robot1``; empty keeps all names.
        shares_transforms: Whether ``/tf`` and ``/tf_static`` keep their names, because a prefix
            tells the frames of robots apart.
        same_network: Whether both ends are the same network, so that names in the namespace are
            there already.
    """

    def __init__(self, namespace: str, *, shares_transforms: bool, same_network: bool) -> None:
        self._prefix = namespace.rstrip("/")
        self._shared = _TRANSFORMS if shares_transforms else set()
        self._same_network = same_network

    def there(self, name: str) -> str | None:
        """Return the name at the far end; None if it is not carried."""
        if name in self._shared:
            return name
        if self._same_network and name.startswith(f"{self._prefix}/"):
            return None
        return self._prefix + name

    def back(self, name: str) -> str | None:
        """Return the name at the near end; None if it is not carried."""
        if name in self._shared:
            return name
        if not name.startswith(f"{self._prefix}/"):
            return None
        near = name[len(self._prefix) :]
        return None if near in self._shared else near

    def node_there(self, full_name: str) -> str:
        """Return the name that a node of the near end has at the far end."""
        return self._prefix + full_name

    def node_back(self, full_name: str) -> str:
        """Return the name that a node of the far end has at the near end."""
        inside = full_name.startswith(f"{self._prefix}/")
        return full_name[len(self._prefix) :] if inside else full_name
