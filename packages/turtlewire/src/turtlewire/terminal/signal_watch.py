"""Handles signals while the main thread waits."""

from __future__ import annotations

import contextlib
import signal
import socket
import threading
from collections.abc import Callable, Collection, Iterator


@contextlib.contextmanager
def watched(numbers: Collection[int], act: Callable[[], object]) -> Iterator[None]:
    """Call ``act`` on a thread at each of these signals.

    Python runs the handler of a signal when its main thread executes bytecode. A signal that comes
    just before the main thread begins to wait, or that another thread receives, does not end that
    wait; ``act`` can. The handlers stay as they are.

    In a thread that is not the main one nothing is watched: signals are the main thread's.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    former = None
    arrived, wakeup = socket.socketpair()
    with arrived:

        def watch() -> None:
            while number := arrived.recv(1):
                if number[0] in numbers:
                    act()

        watcher = threading.Thread(target=watch, name="signals", daemon=True)
        try:
            wakeup.setblocking(False)
            watcher.start()
            former = signal.set_wakeup_fd(wakeup.fileno(), warn_on_full_buffer=False)
            yield
        finally:
            if former is not None:
                with contextlib.suppress(OSError, ValueError):  # its owner may have closed it
                    signal.set_wakeup_fd(former)
            wakeup.close()
            if watcher.ident is not None:
                watcher.join()
