"""Files that appear, or replace an older file, when they are complete."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress

__all__ = ["new_file"]


@contextmanager
def new_file(path: str | os.PathLike[str]) -> Iterator[str]:
    """Yield the path of a file to make, which replaces ``path`` at the end.

    If the block raises an exception, the file is removed, and ``path`` stays as it was. What a
    killed process has left unfinished is removed, too. A symbolic link is followed; a device or a
    pipe cannot be replaced, and is yielded itself.

    Raises:
        OSError: ``path`` cannot be written, or the disk is full. The error names ``path``.
    """
    name = os.fspath(path)
    target = os.path.realpath(name)
    unfinished = f"{target}.part"
    is_special = os.path.exists(name) and not os.path.isfile(name)
    try:
        with nullcontext(name) if is_special else _replacing(target, unfinished):
            yield name if is_special else unfinished
    except OSError as error:
        # The error of a full disk does not name a file.
        if error.errno is None or error.filename not in (None, target, unfinished):
            raise
        raise OSError(error.errno, error.strerror, name) from error


@contextmanager
def _replacing(target: str, unfinished: str) -> Iterator[None]:
    with suppress(FileNotFoundError), open(target, "rb+"):
        pass  # a read-only file must not be replaced
    with suppress(FileNotFoundError):
        os.remove(unfinished)
    try:
        yield
        with suppress(FileNotFoundError):
            shutil.copymode(target, unfinished)
        os.replace(unfinished, target)
    except BaseException:
        with suppress(FileNotFoundError):
            os.remove(unfinished)
        raise
