"""Files and messages of a bag that were compressed as a whole, unpacked for reading."""

from __future__ import annotations

import os
import shutil
from typing import TYPE_CHECKING

from turtlewire.bag.compression import decompress, read_zstd_file
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from turtlewire.bag.message import BagMessage

__all__ = ["unpack_file", "unpacked"]

#: What a decompressed copy leaves free on its disk.
_LEAST_FREE_BYTES = 256 << 20


def unpack_file(path: str, folder: str, damaged: Callable[[str], None]) -> str:
    """Decompress a ``.zstd`` file into a folder, as far as it is whole and fits.

    Args:
        path: The file.
        folder: Where the copy goes.
        damaged: Called if not all of it could be decompressed.

    Returns:
        Path of the copy.
    """
    plain = os.path.join(folder, os.path.basename(path).removesuffix(".zstd"))
    with open(plain, "wb") as out:
        try:
            for block in read_zstd_file(path):
                _check_room(folder, path)
                out.write(block)
        except BagError as error:
            damaged(str(error))
    return plain


def _check_room(folder: str, path: str) -> None:
    if shutil.disk_usage(folder).free < _LEAST_FREE_BYTES:
        raise BagError(
            f"{path}: its decompressed copy in {folder} would fill the disk; what fitted is read"
        ).with_hint("TMPDIR names a folder with more room.")


def unpacked(
    messages: Iterator[BagMessage], compression: str, path: str, damage: list[BagError]
) -> Iterator[BagMessage]:
    """The messages decompressed; those that are damaged are left out and go to ``damage``."""
    for message in messages:
        try:
            data = decompress(compression, message.data)
        except BagError as error:
            at = f"the message of {message.topic} at {message.log_time_ns} ns"
            damage.append(BagError(f"{path}: {at} is left out: {error}"))
            continue
        yield message._replace(data=data)
