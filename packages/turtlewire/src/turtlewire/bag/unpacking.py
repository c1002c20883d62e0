"""Files and messages of a bag that were compressed as a whole, unpacked for reading."""

from __future__ import annotations

import os
import shutil
from typing import TYPE_CHECKING

from turtlewire.bag.compression import USUAL_GROWTH, decompress, read_zstd_file
from turtlewire.errors import BagError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from turtlewire.bag.message import BagMessage

__all__ = ["unpack_file", "unpacked"]

#: What a decompressed copy leaves free on its disk.
_LEAST_FREE_BYTES = 256 << 20


def unpack_file(path: str, folder: str, damaged: Callable[[str], None]) -> str:
    """Decompress a ``.zstd`` file into a folder, as far as it is whole and fits.

    A copy that is more than a thousand times larger takes half of the free room at most: it may be
    a file that was made to fill the disk.

    Args:
        path: The file.
        folder: Where the copy goes.
        damaged: Called if not all of it could be decompressed.

    Returns:
        Path of the copy.
    """
    plain = os.path.join(folder, os.path.basename(path).removesuffix(".zstd"))
    usual_bytes = USUAL_GROWTH * os.path.getsize(path)
    half = max(_LEAST_FREE_BYTES, shutil.disk_usage(folder).free // 2)
    with open(plain, "wb") as out:
        try:
            for block in read_zstd_file(path):
                is_usual = out.tell() + len(block) <= usual_bytes
                _check_room(folder, path, _LEAST_FREE_BYTES if is_usual else half)
                out.write(block)
        except BagError as error:
            damaged(str(error))
    return plain


def _check_room(folder: str, path: str, least_free: int) -> None:
    if shutil.disk_usage(folder).free < least_free:
        raise BagError(
            f"{path}: its decompressed copy in {folder} would leave less than {least_free:,} bytes "
            "of the disk free; only the part before that is read"
        ).with_hint("TMPDIR names a folder with more room.")


def unpacked(
    messages: Iterator[BagMessage], compression: str, path: str, damage: list[BagError]
) -> Iterator[BagMessage]:
    """Yield the messages decompressed; those that are damaged are left out and go to ``damage``."""
    for message in messages:
        try:
            data = decompress(compression, message.data)
        except BagError as error:
            at = f"the message of {message.topic} at {message.log_time_ns} ns"
            damage.append(BagError(f"{path}: {at} is left out: {error}"))
            continue
        yield message._replace(data=data)
