"""Prepares the chunks of MCAP files on another thread, one ahead of the one that is used."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING, TypeVar

from turtlewire.errors import BagError

if TYPE_CHECKING:
    from turtlewire.bag.mcap_reader import McapFile
    from turtlewire.bag.mcap_records import ChunkIndex

__all__ = ["decompressed", "one_ahead"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


def decompressed(
    file: McapFile, chunks: list[ChunkIndex]
) -> Iterator[tuple[ChunkIndex, bytes | memoryview | BagError]]:
    """Yield each chunk with its records, which another thread decompresses one chunk ahead."""

    def load(chunk: ChunkIndex) -> bytes | memoryview | BagError:
        try:
            return file.records(chunk)
        except BagError as error:
            return error

    return one_ahead(chunks, load)


def one_ahead(
    items: Iterable[_Item], prepare: Callable[[_Item], _Result]
) -> Iterator[tuple[_Item, _Result]]:
    """Yield each item with the result of ``prepare``, which another thread calls one item ahead."""
    with ThreadPoolExecutor(1, "bag") as thread:
        following = iter(items)
        ahead = [(item, thread.submit(prepare, item)) for item in islice(following, 1)]
        while ahead:
            item, current = ahead.pop()
            ahead += [(item, thread.submit(prepare, item)) for item in islice(following, 1)]
            yield item, current.result()
