"""Compresses the files of a page, and sends them only to browsers that do not have them.

Nothing else is compressed. The length of a compressed answer can reveal a secret in it if the
answer also contains text of an attacker's choice (the BREACH attack). A file of the page contains
neither the token of the address nor a part of the request.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from turtlewire.web.files import File

__all__ = ["EncodedFile", "Encoder", "has_tag", "takes_gzip"]

#: Media types that are text; pictures are compressed already.
_TEXT_TYPES = ("text/", "application/json", "image/svg+xml")
#: A smaller file fits in one packet of a network, compressed or not [bytes].
_SMALLEST = 1024


class EncodedFile(NamedTuple):
    """The bytes of a file, as one request gets them.

    Attributes:
        body: The bytes, compressed if ``coding`` says so.
        caching: The headers for caches: ``ETag`` and, if the request decides, ``Vary``.
        coding: The header ``Content-Encoding`` of a compressed body.
    """

    body: bytes
    caching: dict[str, str]
    coding: dict[str, str]


class Encoder:
    """Reads files; compresses each once, and again when it has changed. For any thread."""

    def __init__(self) -> None:
        self._kept: dict[tuple[Path, bool], tuple[tuple[int, int], EncodedFile]] = {}

    def read(self, file: File, *, gzipped: bool) -> EncodedFile:
        """Return a file, compressed if ``gzipped`` is true and the file is worth it.

        Raises:
            OSError: The file cannot be read.
        """
        status = file.path.stat()
        state = status.st_mtime_ns, status.st_size
        key = file.path, gzipped
        kept = self._kept.get(key)
        if kept is None or kept[0] != state:
            kept = self._kept[key] = state, _encode(file, gzipped=gzipped)
        return kept[1]


def takes_gzip(fields: Iterable[str]) -> bool:
    """Return whether ``Accept-Encoding`` headers allow gzip."""
    weights = {}
    for word in ",".join(fields).split(","):
        name, *parameters = (part.strip().lower() for part in word.split(";"))
        weights[name] = _weight(parameters)
    return weights.get("gzip", weights.get("x-gzip", weights.get("*", 0.0))) > 0


def has_tag(fields: Iterable[str], tag: str) -> bool:
    """Return whether ``If-None-Match`` headers name the ``ETag`` of what the browser has."""
    known = [word.strip().removeprefix("W/") for word in ",".join(fields).split(",")]
    return tag in known or "*" in known


def _weight(parameters: list[str]) -> float:
    """Return the value of ``q=``, 1 without it, and 0 for a value that is not a number."""
    given = next((part[2:] for part in parameters if part.startswith("q=")), "1")
    try:
        return float(given)
    except ValueError:
        return 0.0


def _encode(file: File, *, gzipped: bool) -> EncodedFile:
    import gzip
    import hashlib

    body = file.path.read_bytes()
    tag = hashlib.sha256(body).hexdigest()[:32]
    if len(body) < _SMALLEST or not file.media_type.startswith(_TEXT_TYPES):
        return EncodedFile(body, {"ETag": f'"{tag}"'}, {})
    varying = {"Vary": "Accept-Encoding"}  # for caches between server and browser
    if not gzipped:
        return EncodedFile(body, {"ETag": f'"{tag}"', **varying}, {})
    caching = {"ETag": f'"{tag}-gzip"', **varying}
    return EncodedFile(gzip.compress(body, mtime=0), caching, {"Content-Encoding": "gzip"})
