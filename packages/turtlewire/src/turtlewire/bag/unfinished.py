"""Folders that appear when they are complete."""

from __future__ import annotations

import errno
import os
import re
import shutil
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

__all__ = ["new_folder"]


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
