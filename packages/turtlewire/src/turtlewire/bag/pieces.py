"""The bags that an operation writes, and folders that appear when they are complete."""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import sqlite3
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

from turtlewire.bag.writer import BagWriter

if TYPE_CHECKING:
    from turtlewire.bag.extra_records import ExtraRecord
    from turtlewire.bag.mcap_records import RawChunk
    from turtlewire.bag.message import BagMessage
    from turtlewire.bag.output_channels import OutputChannels

__all__ = [
    "Pieces",
    "new_folder",
]


@contextmanager
def new_folder(path: str | os.PathLike[str]) -> Iterator[str]:
    """Yield the path of a folder to make, which is moved to ``path`` at the end.

    If the block raises an exception, its files are removed. Files of a killed process, which were
    to become the same folder, are removed first, except on Windows.

    Args:
        path: The folder; it must not exist.

    Raises:
        FileExistsError: ``path`` exists.
        OSError: The disk is full, for example.
    """
    target = os.path.abspath(os.fspath(path))
    _refuse_existing(target)
    parent, name = os.path.split(target)
    _remove_abandoned(parent, name)
    scratch = os.path.join(parent, f".{name}.{os.getpid()}-{threading.get_ident()}.part")
    lock = None
    try:
        lock = _make_locked(scratch)
        yield os.path.join(scratch, name)
        _refuse_existing(target)
        os.rename(os.path.join(scratch, name), target)
    except sqlite3.Error as error:
        number = errno.ENOSPC if "full" in str(error) else errno.EIO
        raise OSError(number, str(error), target) from error
    except OSError as error:
        if error.filename is None or str(error.filename).startswith(scratch):
            raise OSError(error.errno, error.strerror, target) from error
        raise
    finally:
        with _uninterrupted():
            shutil.rmtree(scratch, ignore_errors=True)
            if lock is not None:
                os.close(lock)


def _make_locked(folder: str) -> int | None:
    """Make a folder that is locked while this process lives; return the lock's descriptor."""
    while True:
        os.mkdir(folder)
        lock = _lock(folder)
        if lock is None or os.path.isdir(folder):
            return lock
        os.close(lock)  # another process has removed it before it was locked


def _remove_abandoned(parent: str, name: str) -> None:
    """Remove what killed processes have left of a folder with this name.

    A folder that a living process writes is locked, on this machine or another.
    """
    pattern = re.compile(rf"\.{re.escape(name)}\.\d+-\d+\.part")
    with suppress(OSError):
        for found in filter(pattern.fullmatch, os.listdir(parent)):
            folder = os.path.join(parent, found)
            lock = _lock(folder)
            if lock is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(lock)


def _lock(folder: str) -> int | None:
    """Lock a folder until the descriptor is closed; None if it is locked or cannot be."""
    if sys.platform == "win32":
        return None
    import fcntl

    try:
        descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def _refuse_existing(path: str) -> None:
    if os.path.lexists(path):
        text = "a bag needs a new folder; choose another path, or remove this one first"
        raise FileExistsError(errno.EEXIST, text, path)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Ignore Ctrl-C: a second one must not leave half of what the first one removes."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    former = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, former)


class Pieces:
    """Writes messages into a bag, or into numbered bags below a folder.

    Args:
        folder: The bag; or the folder of the numbered bags, whose names begin with its name.
        channels: The channels of each bag.
        options: Arguments of `BagWriter`.
        numbered: Whether there may be several bags.
        max_bytes: A numbered bag ends before it exceeds this size; 0 for no limit.
        latched: Returns the messages to repeat at the beginning of a bag that starts at a time;
            None repeats nothing.
        metadata: The metadata records of each bag.

    Attributes:
        paths: The bags that were begun, relative to the folder.
        messages: Number of messages written, the repeated ones not included.
        verbatim: The channels that have the numbers of their origin; filled by the first bag.
        attachments: The attachments of the next bag that is not empty.
    """

    def __init__(
        self,
        folder: str,
        channels: OutputChannels,
        options: dict[str, Any],
        *,
        numbered: bool = False,
        max_bytes: int = 0,
        latched: Callable[[int], list[BagMessage]] | None = None,
        metadata: Sequence[ExtraRecord] = (),
    ) -> None:
        self._folder = folder
        self._channels = channels
        self._options = options
        self._numbered = numbered
        self._max_bytes = max_bytes
        self._latched = latched
        self._metadata = metadata
        self._writer: BagWriter | None = None
        self._start_ns: int | None = None
        self._is_empty = True
        self.paths: list[str] = []
        self.messages = 0
        self.verbatim: set[str] = set()
        self.attachments: list[ExtraRecord] = []

    def begin(self, start_ns: int | None) -> None:
        """End the current bag, and remove it if it is empty; its first message begins the next one.

        Args:
            start_ns: The log time of repeated messages; None uses that of the first message.
        """
        writer, self._writer = self._writer, None
        if writer is not None and self._is_empty:
            writer.abandon()
            shutil.rmtree(writer.path)
            self.paths.pop()
        elif writer is not None:
            for extra in (*self._metadata, *self.attachments):
                writer.copy_extra(extra.record)
            self.attachments.clear()
            writer.close()
        self._start_ns = start_ns

    def write(self, name: str, data: bytes, log_time_ns: int, publish_time_ns: int) -> None:
        """Write a message of one of the channels."""
        writer = self.writer(log_time_ns, len(data))
        writer.append(name, data, log_time_ns, publish_time_ns)
        self.messages += 1
        self._is_empty = False

    def copy_chunk(self, chunk: RawChunk) -> None:
        """Append a chunk of an MCAP file whose channels are `verbatim`."""
        self.writer(chunk.start_ns, len(chunk.record)).copy_chunk(chunk)
        self.messages += sum(chunk.counts.values())
        self._is_empty = False

    def close(self) -> None:
        """Finish the last bag."""
        self.begin(None)

    def abandon(self) -> None:
        """Close the files of the current bag as they are, before they are removed."""
        if self._writer is not None:
            self._writer.abandon()

    def writer(self, time_ns: int, size: int) -> BagWriter:
        """Return the bag in which something of a time and size has room."""
        if (
            self._max_bytes
            and self._writer is not None
            and not self._is_empty
            and self._writer.size + size > self._max_bytes
        ):
            self.begin(time_ns)
        if self._writer is None:
            self._open(time_ns if self._start_ns is None else self._start_ns)
        assert self._writer is not None
        return self._writer

    def _open(self, start_ns: int) -> None:
        path = self._folder
        if self._numbered:
            path = os.path.join(path, f"{os.path.basename(path)}_{len(self.paths)}")
        writer = self._writer = BagWriter(path, **self._options)
        self._is_empty = True
        self.paths.append(os.path.relpath(path, os.path.dirname(self._folder)))
        for name, channel in self._channels.channels.items():
            if writer.add_channel(name, channel):
                self.verbatim.add(name)
        for message in self._latched(start_ns) if self._latched else ():
            name = self._channels.name_of_message(message)
            writer.append(name, message.data, message.log_time_ns, message.publish_time_ns)
