"""Decompresses the chunks of an MCAP file, one ahead of the one that is read."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from typing import TYPE_CHECKING

from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from turtlewire.bag.mcap_reader import McapFile
    from turtlewire.bag.mcap_records import ChunkIndex

__all__ = ["decompressed"]


def decompressed(
    file: McapFile, chunks: list[ChunkIndex]
) -> Iterator[tuple[ChunkIndex, bytes | memoryview | BagError]]:
    """Yield each chunk with its records, which another thread decompresses one chunk ahead."""

    def load(chunk: ChunkIndex) -> bytes | memoryview | BagError:
        try:
            return file.records(chunk)
        except BagError as error:
            return error

    with ThreadPoolExecutor(1, "bag") as thread:
        following = iter(chunks)
        ahead = [(chunk, thread.submit(load, chunk)) for chunk in islice(following, 1)]
        while ahead:
            chunk, current = ahead.pop()
            ahead += [(chunk, thread.submit(load, chunk)) for chunk in islice(following, 1)]
            yield chunk, current.result()
