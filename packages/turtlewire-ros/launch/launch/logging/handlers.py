"""The standard library's handlers, with a formatter for each logger.

``StreamHandler``, ``FileHandler`` and all handlers of :mod:`logging.handlers` are here under their
own names. They have two further methods: ``setFormatterFor(logger, formatter)`` and
``unsetFormatterFor(logger)``.
"""

from __future__ import annotations

import logging
import logging.handlers
from typing import Any, TypeVar

_Handler = TypeVar("_Handler", bound=logging.Handler)


def with_per_logger_formatting(cls: type[_Handler]) -> type[_Handler]:
    """Return a subclass of a handler that may have a formatter for each logger."""

    class PerLogger(cls):  # type: ignore[misc, valid-type]  # the base is an argument
        def __init__(self, *args: Any, **kwargs: Any) -> None:
            super().__init__(*args, **kwargs)
            self._formatters: dict[str, logging.Formatter] = {}

        def setFormatterFor(  # noqa: N802  ROS 2's name
            self, logger: logging.Logger, formatter: logging.Formatter
        ) -> None:
            self._formatters[logger.name] = formatter

        def unsetFormatterFor(self, logger: logging.Logger) -> None:  # noqa: N802
            self._formatters.pop(logger.name, None)

        def format(self, record: logging.LogRecord) -> str:
            formatter = self._formatters.get(record.name)
            return super().format(record) if formatter is None else formatter.format(record)

    PerLogger.__name__ = PerLogger.__qualname__ = cls.__name__
    return PerLogger


def __getattr__(name: str) -> Any:
    found = getattr(logging, name, None) or getattr(logging.handlers, name, None)
    if isinstance(found, type) and issubclass(found, logging.Handler):
        # Kept, so that it is the same class each time.
        globals()[name] = with_per_logger_formatting(found)
        return globals()[name]
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
