"""The base of all filters: registered callbacks."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic, overload

from rclpy._typing import MsgT


class SimpleFilter:
    """Passes messages on to registered callbacks. Thread-safe.

    Attributes:
        callbacks: By number, each callback with its further arguments.
    """

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}
        self._next_number = 0
        self._callbacks_lock = threading.Lock()

    def registerCallback(  # noqa: N802 -- ROS 2's name
        self, callback: Callable[..., Any], *args: Any
    ) -> int:
        """Call ``callback(message, …, *args)`` for each message; return the callback's number."""
        with self._callbacks_lock:
            number = self._next_number
            self._next_number += 1
            # A new dictionary, because another thread may be going through the old one.
            self.callbacks = {**self.callbacks, number: (callback, args)}
        return number

    def unregisterCallback(self, conn: int) -> None:  # noqa: N802 -- ROS 2's name
        """Remove a callback; do nothing if it is removed already.

        A message that another thread is passing on may still reach the callback afterwards.

        Args:
            conn: The number that :meth:`registerCallback` returned.
        """
        with self._callbacks_lock:
            self.callbacks = {
                other: entry for other, entry in self.callbacks.items() if other != conn
            }

    def signalMessage(self, *msg: Any) -> None:  # noqa: N802 -- ROS 2's name
        """Pass messages on, in the order of registration."""
        for callback, arguments in self.callbacks.values():
            callback(*msg, *arguments)


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
