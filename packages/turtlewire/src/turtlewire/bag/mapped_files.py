"""Files in memory, whose pages are read when they are needed."""

from __future__ import annotations

import mmap
import os
import sys

from turtlewire.errors import BagError

__all__ = ["forget_pages", "map_file"]

_MAPPED_AT_ONCE = max(1 << 16, mmap.PAGESIZE)  # by Linux, around a page that is read


def map_file(path: str, magic: bytes, kind: str) -> tuple[mmap.mmap, memoryview]:
    """Map a file into memory, and return its bytes.

    Args:
        path: The file.
        magic: The bytes that begin such a file.
        kind: ``"an MCAP file"``, for errors.

    Raises:
        BagError: The file does not begin so.
        OSError: The file cannot be opened.
    """
    with open(path, "rb") as file:
        if os.fstat(file.fileno()).st_size < len(magic):
            raise BagError(f"{path} is not {kind}: it has fewer than {len(magic)} bytes")
        mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    if mapped[: len(magic)] != magic:
        mapped.close()
        raise BagError(f"{path} is not {kind}: it does not begin with its magic bytes")
    return mapped, memoryview(mapped)


def forget_pages(mapped: mmap.mmap, offset: int, length: int) -> None:
    """Release the memory of a part of a mapped file; it is read again when it is needed."""
    if sys.platform != "win32" and hasattr(mmap, "MADV_DONTNEED"):
        # Reading a page maps some before it, too, which were perhaps released already.
        start = offset // _MAPPED_AT_ONCE * _MAPPED_AT_ONCE
        mapped.madvise(mmap.MADV_DONTNEED, start, offset + length - start)
