"""Stand-ins for the handles of ROS 2's C library."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = ["Handle"]


class Handle:
    """Gives what its owner has.

    A ``with`` block around it, as programs for ROS 2 write one, leaves the owner as it is.
    """

    def __init__(self, owner: Any) -> None:
        self._owner = owner

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        """Nothing to release."""

    def __getattr__(self, name: str) -> Any:
        return getattr(self._owner, name)
