"""Keys of the console of Windows, as the bytes that a terminal would send for them."""

from __future__ import annotations

import contextlib
import os
import queue
import sys
import threading
from collections.abc import Callable, Iterator
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from typing_extensions import Self

#: Windows has none that would have to be handled.
ENDING_SIGNALS: tuple[int, ...] = ()

#: The console sends two characters for a key without a letter; the first is one of these.
_SPECIAL = ("\x00", "\xe0")
_ARROWS = {"H": b"\x1b[A", "P": b"\x1b[B", "M": b"\x1b[C", "K": b"\x1b[D"}
_CTRL_C = "\x03"


class ConsoleKeyboard:
    """The keys of the console within a ``with`` block.

    A thread reads them, because the console cannot be waited for together with anything else. It
    ends with the process, or with the first key after :meth:`stop`.

    Args:
        fd: Ignored; for the same signature as `PosixKeyboard`.
        read_character: Waits for a character; None uses the console's.

    Raises:
        OSError: The process has no console.
    """

    def __init__(self, fd: int = 0, read_character: Callable[[], str] | None = None) -> None:
        del fd
        self._read_character = read_character or _console()
        self._bytes: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._stopped = False

    def __enter__(self) -> Self:
        threading.Thread(target=self._run, name="turtlewire-keys", daemon=True).start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.stop()

    def _run(self) -> None:
        while not self._stopped:
            character = self._read_character()
            if character == _CTRL_C:  # it arrives as a key while the console is read
                self.stop()
            elif character in _SPECIAL:
                self._type(_ARROWS.get(self._read_character(), b""))
            else:
                self._type(character.encode())

    def _type(self, typed: bytes) -> None:
        for byte in typed:
            self._bytes.put(bytes([byte]))

    def read(self) -> bytes:
        """Wait for the next byte; empty after Ctrl-C or when :meth:`stop` was called."""
        return b"" if self._stopped else self._bytes.get()

    def read_within(self, seconds: float) -> bytes | None:
        """Wait at most this long for the next byte; None if none was typed."""
        if self._stopped:
            return b""
        try:
            return self._bytes.get(timeout=seconds)
        except queue.Empty:
            return None

    def stop(self) -> None:
        """End the present and all later reads. Safe from any thread."""
        self._stopped = True
        self._bytes.put(b"")


@contextlib.contextmanager
def signals_for_this_thread(*numbers: int) -> Iterator[None]:
    """Do nothing: on Windows only the main thread handles signals."""
    del numbers
    yield


def foreground_terminal() -> int:
    """Standard input, which must be a console.

    Raises:
        OSError: The process has no console.
    """
    if not os.isatty(0):
        raise OSError("standard input is not a console")
    return 0


def _console() -> Callable[[], str]:
    if sys.platform != "win32":
        raise OSError("only Windows has a console")
    import msvcrt

    return msvcrt.getwch
