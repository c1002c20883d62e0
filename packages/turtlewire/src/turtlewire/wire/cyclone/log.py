"""Cyclone's log messages, reworded for users and limited in number.

Cyclone writes a line on stderr for every datagram that the network refuses or a peer garbles, and
has no setting for it; its ``dds_set_log_sink`` is not exported by the library in the wheel. A
domain writes to what C's ``stderr`` was when it was made; so for that moment ``stderr`` is a pipe,
which one of our threads reads. (Python writes on file descriptor 2, which stays as it is.) When
Cyclone aborts the process, the compiled core writes on stderr what the pipe still holds.
"""

from __future__ import annotations

import ctypes
import os
import re
import select
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from turtlewire.wire.report import warn

#: Length of a period in seconds, and the lines to pass on in each; the others are counted.
_PERIOD_S = 60.0
_LINES = 5
_MAX_LETTERS = 300
_BLOCK = 1 << 16
# patterns, compiled when there is something to say
_HEAD = r"[\d.]+ \[\w*\] +\S+: "
_REFUSED = r"ddsi_udp_conn_write to udp/(.+):\d+ failed"
#: Fast DDS counts packets in its own submessages (0x80), and has its own endpoints for that.
#: Cyclone cannot read them, loses nothing by it, and no user can act on it.
_STATISTICS = (
    r"malformed packet received from vendor 1\.15 state parse:UNKNOWN\(80\)|"
    r"invalid parameter list \(vendor 1\.15, [^)]*\): pid 5a \(ENDPOINT_GUID\) invalid|"
    r"Invalid \w+BuiltinTopicData \(vendor 1\.15\): invalid qos/parameters"
)
_STDERR = {"linux": "stderr", "darwin": "__stderrp"}


def explain(line: str) -> str:
    """Return a line of Cyclone's, without its time and thread, as a sentence of ours."""
    refused = re.match(_REFUSED, line)
    if refused:
        return (
            f"the network rejects packets to {refused.group(1)}: is the link down? "
            "Reliable messages are sent again once it is up."
        )
    if len(line) > _MAX_LETTERS:
        line = f"{line[:_MAX_LETTERS]}…"
    return f"Cyclone DDS says: {line}"


class LineLimiter:
    """Chooses the lines to pass on: a few kinds in a period, each once, and a count of the rest.

    Attributes:
        period_end: When the period ends, in the seconds of the caller's clock; None between two.
    """

    def __init__(self) -> None:
        self.period_end: float | None = None
        self._kinds: set[str] = set()
        self._more = 0
        self._last = ""

    def sentences(self, line: str, now: float) -> list[str]:
        """Return the sentences for a line of Cyclone's log."""
        said = self.summary(now)
        if self.period_end is None:
            self.period_end = now + _PERIOD_S
        kind = re.sub(r"<.*|[0-9a-f]*\d[0-9a-f]*", "#", line)  # without dumps and numbers
        if kind in self._kinds or len(self._kinds) >= _LINES:
            self._more += 1
            self._last = line
        else:
            self._kinds.add(kind)
            said.append(explain(line))
        return said

    def summary(self, now: float) -> list[str]:
        """Return a summary of the lines that were left out, once the period has ended."""
        if self.period_end is None or now < self.period_end:
            return []
        more, self._more, self.period_end = self._more, 0, None
        self._kinds.clear()
        return [f"{explain(self._last)} (the last of {more} more lines)"] if more else []


class CycloneLog:
    """The pipe, which lasts as long as the process because Cyclone keeps it, and its reader."""

    def __init__(self) -> None:
        self._thread: threading.Thread | None = None
        self._ending = False
        self._file = None
        self._read_end = self._write_end = -1
        if sys.platform == "win32" or sys.platform not in _STDERR:
            return
        libc = ctypes.CDLL(None)
        try:
            self._stderr = ctypes.c_void_p.in_dll(libc, _STDERR[sys.platform])
        except ValueError:  # another C library: Cyclone keeps writing to stderr
            return
        self._read_end, self._write_end = os.pipe()
        # Lines are lost when the pipe is full: a thread of Cyclone's must not wait for one of ours,
        # which may be waiting for its lock.
        os.set_blocking(self._write_end, False)
        os.set_blocking(self._read_end, False)
        libc.fdopen.restype = ctypes.c_void_p
        libc.fdopen.argtypes = (ctypes.c_int, ctypes.c_char_p)
        self._file = libc.fdopen(self._write_end, b"w")
        _print_on_abort(self._read_end)

    @contextmanager
    def capturing(self) -> Iterator[None]:
        """Have a domain that is made within this context write its log into the pipe."""
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
        """Return the unread lines; for the time before :meth:`start`."""
        if self._file is None or self._thread is not None:
            return []
        return list(filter(None, map(_text_of, self._read().splitlines())))

    def _read(self) -> bytes:
        with suppress(BlockingIOError):
            return os.read(self._read_end, _BLOCK)
        return b""

    def start(self) -> None:
        """Begin to pass on what is written, unless that has begun."""
        if self._file is not None and self._thread is None:
            self._ending = False
            self._thread = threading.Thread(target=self._run, name="turtlewire-log", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        if sys.platform == "win32":
            return
        limiter, unfinished = LineLimiter(), b""
        readable = select.poll()
        readable.register(self._read_end, select.POLLIN)
        while not self._ending:
            end = limiter.period_end
            readable.poll(None if end is None else max(0.0, end - time.monotonic()) * 1000)
            *lines, unfinished = (unfinished[-_BLOCK:] + self._read()).split(b"\n")
            now = time.monotonic()
            for text in filter(None, map(_text_of, lines)):
                _warn_each(limiter.sentences(text, now))
            _warn_each(limiter.summary(now))

    def stop(self) -> None:
        """End the thread."""
        if self._thread is not None:
            self._ending = True
            with suppress(BlockingIOError):  # full, so there is something to wake it
                os.write(self._write_end, b"\n")
            self._thread.join()
            self._thread = None


def _warn_each(sentences: list[str]) -> None:
    for sentence in sentences:
        warn(sentence)


def _text_of(line: bytes) -> str:
    """A line without its time and thread; empty if it is about the statistics of Fast DDS."""
    text = re.sub(_HEAD, "", line.decode("utf-8", "replace").strip(), count=1)
    return "" if re.match(_STATISTICS, text) else text


def _print_on_abort(pipe: int) -> None:
    """Write the content of ``pipe`` on stderr when the process aborts (compiled core only)."""
    with suppress(ModuleNotFoundError):
        from turtlewire._native import print_on_abort

        print_on_abort(pipe)
