"""Passes on the messages in which fields have changed.

``PathDeltaFilter(["header.frame_id"], subscriber)`` passes a message on if its frame differs
from that of the previous message. For other comparisons, derive from `ComparisonHandler`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from .simple_filter import SimpleFilter


class ComparisonHandler(ABC):
    """Decides which messages pass a :class:`ComparisonFilter`."""

    @abstractmethod
    def do_fields_fit(self, field_a: Any, field_b: Any) -> bool:
        """Return True if two values of a field let a message pass."""

    @abstractmethod
    def message_fits(self, message: Any) -> bool:
        """Return True if a message passes."""


class CachedComparisonHandler(ComparisonHandler):
    """A handler that compares each message with the one before.

    Attributes:
        message_cache: The message before, or None.
    """

    def __init__(self) -> None:
        self.message_cache: Any = None


class DeltaCompare(CachedComparisonHandler):
    """Lets a message pass if one of its fields has changed; the first message passes.

    Args:
        field_getters: For each field, a function that takes a message and returns the value.
    """

    def __init__(self, field_getters: Sequence[Callable[[Any], Any]]) -> None:
        super().__init__()
        self._field_getters = list(field_getters)

    def do_fields_fit(self, val_a: Any, val_b: Any) -> bool:
        """Return True if two values differ."""
        difference = val_a != val_b
        # Fields that are numpy arrays are compared number by number.
        return bool(difference.any() if hasattr(difference, "any") else difference)

    def message_fits(self, message: Any) -> bool:
        """Return True if a field has another value than in the message before."""
        former, self.message_cache = self.message_cache, message
        return former is None or any(
            self.do_fields_fit(get(former), get(message)) for get in self._field_getters
        )


class ComparisonFilter(SimpleFilter):
    """Passes on the messages that a handler lets pass.

    Messages have to arrive in one thread at a time.

    Args:
        comparison_handler: Decides about each message.
        message_filter: The filter to listen to; None if you :meth:`add` messages yourself.
    """

    def __init__(
        self, comparison_handler: ComparisonHandler, message_filter: SimpleFilter | None = None
    ) -> None:
        super().__init__()
        self._comparison_handler = comparison_handler
        self._input: tuple[SimpleFilter, int] | None = None
        if message_filter is not None:
            self.connectInput(message_filter)

    def connectInput(self, message_filter: SimpleFilter) -> None:  # noqa: N802 -- ROS 2's name
        """Listen to a filter, instead of the one before."""
        if self._input is not None:
            former, number = self._input
            former.unregisterCallback(number)
        self._input = message_filter, message_filter.registerCallback(self.add)

    def message_fits(self, message: Any) -> bool:
        """Return True if the handler lets a message pass."""
        return self._comparison_handler.message_fits(message)

    def add(self, message: Any) -> None:
        """Pass a message on, or drop it."""
        if self.message_fits(message):
            self.signalMessage(message)


class DeltaFilter(ComparisonFilter):
    """Passes on the messages in which a field has changed; see :class:`DeltaCompare`.

    Args:
        field_getters: For each field, a function that takes a message and returns the value.
        message_filter: The filter to listen to; None if you ``add`` messages yourself.
    """

    def __init__(
        self,
        field_getters: Sequence[Callable[[Any], Any]],
        message_filter: SimpleFilter | None = None,
    ) -> None:
        super().__init__(DeltaCompare(field_getters), message_filter)


class PathDeltaFilter(DeltaFilter):
    """Passes on the messages in which a field has changed, given by the names of the fields.

    Args:
        field_path_list: The fields; names with dots between them, such as ``pose.position.x``.
        message_filter: The filter to listen to; None if you ``add`` messages yourself.
    """

    def __init__(
        self, field_path_list: Sequence[str], message_filter: SimpleFilter | None = None
    ) -> None:
        if isinstance(field_path_list, str):
            raise TypeError(f"field_path_list is a list of paths: write [{field_path_list!r}]")
        getters = [partial(self.get_field_by_path, field_path=path) for path in field_path_list]
        super().__init__(getters, message_filter)

    def get_field_by_path(self, message: Any, field_path: str) -> Any:
        """Return the value of a field.

        Raises:
            AttributeError: The message has no such field.
        """
        value = message
        for name in field_path.split("."):
            if not hasattr(value, name):
                known: dict[str, str] = getattr(value, "get_fields_and_field_types", dict)()
                has = f"it has {', '.join(known)}" if known else "it has no fields"
                raise AttributeError(
                    f"'{field_path}': {type(value).__name__} has no field '{name}'; {has}"
                )
            value = getattr(value, name)
        return value
