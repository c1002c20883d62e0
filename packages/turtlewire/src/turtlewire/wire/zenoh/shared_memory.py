"""Writes large messages into shared memory, where it is enabled.

Zenoh moves what it is given there as well, but first into memory of its own: an image would be
copied once more, into fresh pages each time.
"""

from __future__ import annotations

import json
import threading

import zenoh
from zenoh import shm

from turtlewire.wire.report import warn_once

from .library import reason_of

__all__ = ["SharedMemory"]

_KEY = "transport/shared_memory"
#: Smaller messages take longer to place than to copy.
_LARGE = 64 * 1024


class SharedMemory:
    """The pool into which a context's publishers write large messages. Thread-safe.

    The pool has the size of the one that Zenoh makes for itself, and is made for the first large
    message.

    Args:
        configuration: Says whether there is shared memory, and how much.
    """

    def __init__(self, configuration: zenoh.Config) -> None:
        settings = json.loads(configuration.get_json(_KEY))
        optimization = settings["transport_optimization"]
        self._lock = threading.RLock()
        self._provider: shm.ShmProvider | None = None
        self._size: int = optimization["pool_size"]
        self._is_usable: bool = settings["enabled"] and optimization["enabled"]
        self._threshold: int = max(_LARGE, optimization["message_size_threshold"])

    def placed(self, cdr: bytes) -> bytes | shm.ZShmMut:
        """Return a copy in shared memory, or the message itself if the pool is full or missing."""
        if not self._is_usable or len(cdr) < self._threshold:
            return cdr
        provider = self._provider or self._open()
        if provider is None:
            return cdr
        try:
            # Does not wait: a subscriber that has stopped would hold up the publisher forever.
            buffer = provider.alloc(len(cdr), shm.GarbageCollect())
        except zenoh.ZError:
            return cdr
        buffer[: len(cdr)] = cdr
        return buffer

    def _open(self) -> shm.ShmProvider | None:
        """Make the pool; None if that fails or the context is closed."""
        with self._lock:
            if self._provider is None and self._is_usable:
                try:
                    self._provider = shm.ShmProvider.default_backend(self._size)
                except zenoh.ZError as error:
                    self._is_usable = False
                    warn_once("shared memory", f"messages are copied: {reason_of(error)}")
            return self._provider

    def close(self) -> None:
        """Free the pool, once no publisher uses it any more."""
        with self._lock:
            self._is_usable = False
            self._provider = None
