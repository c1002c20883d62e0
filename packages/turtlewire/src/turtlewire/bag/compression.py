"""Decompresses and compresses the chunks, files and messages of bags.

Zstandard comes from the standard library on Python 3.14 and from its backport before. LZ4 is an
optional extra, because rosbag2 writes it only on request.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from turtlewire.errors import BagError
from turtlewire.new_file import new_file

if TYPE_CHECKING:
    from turtlewire.bag.message import BagMessage

__all__ = [
    "USUAL_GROWTH",
    "ZSTD_MAGIC",
    "compress",
    "decompress",
    "most_bytes",
    "read_zstd_file",
    "unpack_file",
    "unpacked",
    "write_zstd_file",
]

#: What a frame of zstd begins with.
ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"

#: A chunk or message that is larger when decompressed is refused: a few damaged or hostile bytes
#: must not make a reader ask for all memory. rosbag2 writes chunks of 768 KiB by default.
_MAX_BYTES = 1 << 32

#: Bytes that any number of compressed bytes may hold. An occupancy grid of one value grows as much
#: as a bomb does (20,000-fold), so growth alone is not a reason to reject it.
_ALWAYS_BYTES = 1 << 30

#: Larger chunks, messages and files usually grow less: those of sensors grow tenfold.
USUAL_GROWTH = 1000

#: Level 1 compresses TF at 1 GB/s to 29 %; level 19 takes 300 times longer for 27 % (measured).
_ZSTD_LEVEL = 1

_FILE_BLOCK = 1 << 20


def most_bytes(packed: int) -> int:
    """Return how many bytes a chunk or message of ``packed`` compressed bytes may hold.

    `decompress` refuses more, and writers must not write more.
    """
    return min(_MAX_BYTES, max(_ALWAYS_BYTES, USUAL_GROWTH * packed))


def decompress(
    compression: str, data: bytes | memoryview, size: int | None = None, *, cut: bool = False
) -> bytes:
    """Decompress one chunk or one message.

    Args:
        compression: ``""`` (none), ``"zstd"`` or ``"lz4"``.
        data: The compressed bytes.
        size: The decompressed number of bytes; None if it is not known.
        cut: Whether the data may end early; the intact beginning is returned.

    Raises:
        BagError: The bytes are damaged, do not have that size, hold more than `most_bytes` or more
            than the process can allocate, or need a package that is missing.
    """
    if not compression:
        return bytes(data)
    limit = most_bytes(len(data))
    if size is not None and size > limit:
        raise BagError(
            f"a chunk of {len(data)} bytes says that it holds {size} bytes; at most {limit} are "
            "read"
        )
    try:
        out = _decompressor(compression)(data, limit if size is None else size, cut)
    except MemoryError:
        raise BagError(
            f"{len(data)} bytes decompress to more than the memory that this process can get"
        ) from None
    if size is None and len(out) > limit:
        raise BagError(f"a message of {len(data)} bytes decompresses to more than {limit} bytes")
    if size is not None and len(out) != size and not (cut and len(out) < size):
        raise BagError(f"a chunk decompresses to {len(out)} bytes instead of {size}")
    return out


def compress(compression: str, data: bytes, level: int = _ZSTD_LEVEL) -> bytes:
    """Compress one chunk or one message; ``compression`` and errors as in `decompress`."""
    if compression == "":
        return data
    if compression == "zstd":
        packed: bytes = _zstd().compress(data, level)
        return packed
    if compression == "lz4":
        return bytes(_lz4_frame().compress(data))
    raise BagError(f"unknown compression '{compression}'").with_hint(
        "Use 'zstd', 'lz4' or '' for no compression."
    )


def read_zstd_file(path: str) -> Iterator[bytes]:
    """Yield the decompressed blocks of a ``.zstd`` file, at most a few megabytes at a time.

    Raises:
        BagError: The file is damaged or ends too early.
    """
    zstd = _zstd()
    decompressor = zstd.ZstdDecompressor()
    with open(path, "rb") as file:
        while True:
            block = b""
            if decompressor.needs_input:
                block = decompressor.unused_data if decompressor.eof else file.read(_FILE_BLOCK)
                if not block:
                    break
            try:
                yield decompressor.decompress(block, _FILE_BLOCK)
            except zstd.ZstdError as error:
                raise BagError(f"{path}: damaged before byte {file.tell()}: {error}") from None
            if decompressor.eof:
                break
    if not decompressor.eof:
        raise BagError(f"{path}: the compressed file ends too early")


def write_zstd_file(source: str, target: str) -> None:
    """Compress a whole file as rosbag2's compression mode FILE does (level 1).

    Raises:
        OSError: The disk is full, for example; no target is left.
    """
    with (
        new_file(target) as path,
        open(source, "rb") as file,
        _zstd().open(path, "wb", level=_ZSTD_LEVEL) as out,
    ):
        shutil.copyfileobj(file, out, _FILE_BLOCK)


def _decompressor(compression: str) -> Callable[[bytes | memoryview, int, bool], bytes]:
    if compression == "zstd":
        return _decompress_zstd
    if compression == "lz4":
        return _decompress_lz4
    raise BagError(f"unknown compression '{compression}'").with_hint("Use 'zstd' or 'lz4'.")


def _decompress_zstd(data: bytes | memoryview, size: int, cut: bool) -> bytes:
    zstd = _zstd()
    decompressor = zstd.ZstdDecompressor()
    try:
        # One byte more than announced shows a chunk that holds more than it says.
        out: bytes = decompressor.decompress(data, size + 1)
    except zstd.ZstdError as error:
        raise BagError(f"damaged zstd data: {error}") from None
    if not decompressor.eof and len(out) <= size and not cut:
        raise BagError("the zstd data end too early")
    return out


def _decompress_lz4(data: bytes | memoryview, size: int, _cut: bool) -> bytes:
    frame = _lz4_frame()
    try:
        out: bytes = frame.LZ4FrameDecompressor().decompress(bytes(data), size + 1)
    except (RuntimeError, EOFError) as error:
        raise BagError(f"damaged lz4 data: {error}") from None
    return out


def _zstd() -> Any:
    try:
        if sys.version_info >= (3, 14):
            from compression import zstd
        else:
            from backports import zstd
    except ModuleNotFoundError:
        raise BagError("zstd needs the package 'backports.zstd', which is missing").with_hint(
            "Install it with `pip install backports.zstd`, which compiles it where there is no "
            "wheel; Python 3.14 needs no package."
        ) from None
    return zstd


def _lz4_frame() -> Any:
    try:
        import lz4.frame
    except ImportError:
        raise BagError("lz4 needs the package 'lz4', which is missing").with_hint(
            "Install it with `pip install lz4`."
        ) from None
    return lz4.frame


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
