"""What Cyclone has to complain about, in words for people and not each time anew.

Cyclone writes a line on stderr for every datagram that the network refuses, ten a second and more,
and has no setting for it; its ``dds_set_log_sink`` is not exported by the library in the wheel. A
domain writes to what C's ``stderr`` was when it was made; so for that moment ``stderr`` is a pipe,
which a thread of ours reads. (Python writes on file descriptor 2, which stays as it is.) What
Cyclone says right before it aborts is lost with the process; so what makes it abort is kept from
it, see ``configuration``.
"""

from __future__ import annotations

import ctypes
import os
import re
import sys
import threading
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from turtlewire.wire.report import warn

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["CycloneLog", "explain"]

#: What is about the same is said once in this time.
_SILENCE_S = 60.0
# patterns, compiled when there is something to say
_HEAD = r"[\d.]+ \[\w*\] +\S+: "
_REFUSED = r"ddsi_udp_conn_write to udp/(.+):\d+ failed"
_STDERR = {"linux": "stderr", "darwin": "__stderrp"}


def explain(line: str) -> str:
    """A line of Cyclone's, without its time and thread, as a sentence of ours."""
    refused = re.match(_REFUSED, line)
    if refused:
        return f"the network does not let us send to {refused.group(1)}: is the link down? Reliable messages are sent again once it is up."
    return f"Cyclone DDS says: {line}"


class CycloneLog:
    """The pipe, which lasts as long as the process because Cyclone keeps it, and its reader."""

    def __init__(self) -> None:
        self._thread: threading.Thread | None = None
        self._ending = False
        self._silent_until: dict[str, float] = {}
        self._file = None
        if sys.platform not in _STDERR:
            return
        libc = ctypes.CDLL(None)
        try:
            self._stderr = ctypes.c_void_p.in_dll(libc, _STDERR[sys.platform])
        except ValueError:  # a C library of another kind: Cyclone goes on writing on stderr
            return
        self._read_end, self._write_end = os.pipe()
        # Lines are lost when the pipe is full: a thread of Cyclone's must not wait for one of ours,
        # which may be waiting for its lock.
        os.set_blocking(self._write_end, False)
        libc.fdopen.restype = ctypes.c_void_p
        libc.fdopen.argtypes = (ctypes.c_int, ctypes.c_char_p)
        self._file = libc.fdopen(self._write_end, b"w")

    @contextmanager
    def capturing(self) -> Iterator[None]:
        """A domain that is made meanwhile writes into the pipe."""
        if self._file is None:
            yield
            return
        before = self._stderr.value
        self._stderr.value = self._file
        try:
            yield
        finally:
            self._stderr.value = before

    def unread(self) -> list[str]:
        """What was said and nobody has read; for the time before :meth:`start`."""
        if self._file is None or self._thread is not None:
            return []
        os.set_blocking(self._read_end, False)
        text = b""
        with suppress(BlockingIOError):
            text = os.read(self._read_end, 1 << 16)
        os.set_blocking(self._read_end, True)
        return [_text_of(line) for line in text.splitlines()]

    def start(self) -> None:
        """Begin to pass on what is said, unless that has begun."""
        if self._file is not None and self._thread is None:
            self._ending = False
            self._thread = threading.Thread(target=self._run, name="turtlewire-log", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        with open(self._read_end, "rb", closefd=False) as lines:
            for line in lines:
                if self._ending:
                    return
                self._say(_text_of(line))

    def _say(self, text: str) -> None:
        kind = re.sub(r"\d+", "#", text)
        now = time.monotonic()
        if text and now >= self._silent_until.get(kind, now):
            self._silent_until[kind] = now + _SILENCE_S
            warn(explain(text))

    def stop(self) -> None:
        """End the thread."""
        if self._thread is not None:
            self._ending = True
            with suppress(BlockingIOError):  # full, so there is something to wake it
                os.write(self._write_end, b"\n")
            self._thread.join()
            self._thread = None


def _text_of(line: bytes) -> str:
    return re.sub(_HEAD, "", line.decode("utf-8", "replace").strip(), count=1)
