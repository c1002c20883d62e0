"""Filters that pass on one message at a time: their callbacks are checked by type checkers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, overload

from rclpy._typing import MsgT

from .simple_filter import SimpleFilter

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["OneMessageFilter"]


class OneMessageFilter(SimpleFilter, Generic[MsgT]):
    """Passes messages of one class on, as ``Subscriber[PointStamped]`` does."""

    if TYPE_CHECKING:

        @overload
        def registerCallback(self, callback: Callable[[MsgT], Any]) -> int: ...

        @overload
        def registerCallback(
            self, callback: Callable[..., Any], arg: Any, /, *args: Any
        ) -> int: ...

        # Narrower than that of the base, which passes on any number of messages.
        def registerCallback(  # noqa: N802 -- as in the base
            self, callback: Callable[..., Any], *args: Any
        ) -> int: ...
