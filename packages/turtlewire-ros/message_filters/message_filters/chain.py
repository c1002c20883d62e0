"""Combines a sequence of filters into one filter."""

from __future__ import annotations

from typing import Any

from .simple_filter import SimpleFilter


class Chain(SimpleFilter):
    """Passes messages through filters, one behind the other; what leaves the last leaves the chain.

    The first filter may have its own messages, as a :class:`Subscriber` has; otherwise it takes the
    messages of :meth:`connectInput` and :meth:`add`. A chain without filters passes nothing on.
    Connect and add filters in one thread; messages may arrive in any thread.

    Args:
        message_filter: The filter to listen to; None if the first filter of the chain has its own
            messages, or if you :meth:`add` messages yourself.
    """

    def __init__(self, message_filter: SimpleFilter | None = None) -> None:
        super().__init__()
        self._filters: list[SimpleFilter] = []
        self._output = 0
        self._input: tuple[SimpleFilter, int] | None = None
        if message_filter is not None:
            self.connectInput(message_filter)

    def addFilter(self, message_filter: SimpleFilter) -> int:  # noqa: N802 -- ROS 2's name
        """Put a filter behind those that are in the chain.

        Args:
            message_filter: The filter. All but the first need a ``connectInput``.

        Returns:
            Its index, for :meth:`getFilter`.

        Raises:
            TypeError: The filter takes no input, and is not the first.
        """
        if self._filters:
            connect = getattr(message_filter, "connectInput", None)
            if connect is None:
                raise TypeError(
                    f"{type(message_filter).__name__} has no connectInput, so that it can only be "
                    "the first filter of a chain"
                )
            last = self._filters[-1]
            last.unregisterCallback(self._output)
            connect(last)
        self._filters.append(message_filter)
        self._output = message_filter.registerCallback(self.signalMessage)
        return len(self._filters) - 1

    def getFilter(self, index: int) -> SimpleFilter | None:  # noqa: N802 -- ROS 2's name
        """Return the filter with an index, or None."""
        return self._filters[index] if 0 <= index < len(self._filters) else None

    def connectInput(self, message_filter: SimpleFilter) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to a filter, instead of the one before."""
        if self._input is not None:
            former, number = self._input
            former.unregisterCallback(number)
        self._input = message_filter, message_filter.registerCallback(self.add)

    def add(self, message: Any) -> None:
        """Give a message to the first filter.

        Raises:
            TypeError: The first filter has only its own messages.
        """
        if not self._filters:
            return
        first = self._filters[0]
        add = getattr(first, "add", None)
        if add is None:
            raise TypeError(
                f"the first filter of the chain, a {type(first).__name__}, accepts no messages: "
                "use the chain without an input, or with another first filter"
            )
        add(message)
