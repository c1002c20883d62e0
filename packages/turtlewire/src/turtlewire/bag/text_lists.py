"""Lists of texts in CDR, such as the names of joints."""

from __future__ import annotations

from functools import lru_cache

__all__ = ["read_texts"]


@lru_cache(maxsize=64)  # a publisher sends the same names in each message
def read_texts(data: bytes) -> tuple[str, ...]:
    """Return the elements of a sequence of strings in little endian CDR, without its count."""
    texts, at = [], 0
    while at < len(data):
        begin = -(-at // 4) * 4 + 4
        at = begin + int.from_bytes(data[begin - 4 : begin], "little")
        texts.append(data[begin : max(begin, at - 1)].decode())
    return tuple(texts)
