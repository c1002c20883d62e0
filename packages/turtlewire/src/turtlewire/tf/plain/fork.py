"""fork() waits for the locks of all buffers.

It copies only the thread that calls it: a lock that another thread holds at that moment would stay
locked in the child forever, and what it guards half changed.
"""

from __future__ import annotations

import os
import threading
from weakref import WeakSet

_guarded: WeakSet[threading.RLock] = WeakSet()
_registry = threading.Lock()
_held: list[threading.RLock] = []


def guard(lock: threading.RLock) -> None:
    """Make fork() acquire the lock first, as long as the lock exists."""
    with _registry:
        _guarded.add(lock)


def _before() -> None:
    _registry.acquire()
    _held.extend(_guarded)
    for lock in _held:
        lock.acquire()


def _after() -> None:
    for lock in _held:
        lock.release()
    _held.clear()
    _registry.release()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_before, after_in_parent=_after, after_in_child=_after)
