"""Calls a function when several callers are ready."""

from __future__ import annotations

import threading
from collections.abc import Callable


class ReadyAggregator:
    """Calls a function at the n-th call of :meth:`ready_fn`. Safe from any thread.

    Args:
        ready_fn: The function.
        num_to_aggregate: The n.
    """

    def __init__(self, ready_fn: Callable[[], object], num_to_aggregate: int) -> None:
        self._function = ready_fn
        self._missing = num_to_aggregate
        self._lock = threading.Lock()

    def ready_fn(self) -> None:
        """Count one more caller as ready."""
        with self._lock:
            self._missing -= 1
            is_last = self._missing == 0
        if is_last:
            self._function()
