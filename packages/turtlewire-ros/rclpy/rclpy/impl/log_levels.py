"""The level of each logger. Thread-safe.

A logger without a level inherits the level of its nearest ancestor (``a`` is the parent of
``a.b``), else the default.
"""

from __future__ import annotations

import threading

from .logging_severity import LoggingSeverity

_lock = threading.Lock()
#: The level of the empty name is the default of all loggers.
_own: dict[str, int] = {"": LoggingSeverity.INFO.value}
#: What :func:`effective` has found; emptied at every change, so that a disabled message costs one
#: look-up.
_effective: dict[str, int] = {}


def set_level(name: str, level: int) -> None:
    """Set the level of a logger.

    An empty name means the default of all loggers, for which UNSET lets all messages through; any
    other logger inherits again when it is UNSET.
    """
    with _lock:
        if name and level == LoggingSeverity.UNSET:
            _own.pop(name, None)
        else:
            _own[name] = int(level)
        _effective.clear()


def own(name: str) -> int:
    """Return the level that was set for exactly this logger, or UNSET."""
    return _own.get(name, LoggingSeverity.UNSET.value)


def effective(name: str) -> int:
    """Return the level that decides about a message of this logger."""
    # Without the lock: a single look-up is atomic, and most messages end here.
    level = _effective.get(name)
    return _find(name) if level is None else level


def reset() -> None:
    """Forget all levels: INFO is the default again."""
    with _lock:
        _own.clear()
        _own[""] = LoggingSeverity.INFO.value
        _effective.clear()


def _find(name: str) -> int:
    with _lock:
        ancestor = name
        while ancestor not in _own:
            ancestor = ancestor.rpartition(".")[0]
        level = _own[ancestor]
        _effective[name] = level
        return level
