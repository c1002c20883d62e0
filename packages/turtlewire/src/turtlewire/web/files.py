"""The files of a page, found when the server starts, and the headers and bodies of its responses.

A page may hold import maps, ``<script type="importmap">``: the only scripts that must be inline.
The policy allows them by their hashes.

Files are compressed, and sent only to browsers that do not have them. Nothing else is compressed:
the length of a compressed answer can reveal a secret in it if the answer also contains text of an
attacker's choice (the BREACH attack). A file of the page contains neither the token of the address
nor a part of the request.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

#: Suffix to media type. A page consists of nothing else.
_MEDIA_TYPES = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".ico": "image/x-icon",
    ".js": "text/javascript; charset=utf-8",
    ".json": "application/json",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}
#: Everything comes from this server, and no other page may embed this one.
_SOURCES = {
    "default-src": "'none'",
    "script-src": "'self'",
    "style-src": "'self'",
    "img-src": "'self' data: blob:",
    "connect-src": "'self' ws://{host}",
    "base-uri": "'none'",
    "form-action": "'none'",
    "frame-ancestors": "'none'",
}
_IMPORT_MAP = re.compile(rb'<script type="importmap">(.*?)</script>', re.DOTALL)


class WebContent(NamedTuple):
    """An answer to a request.

    Attributes:
        body: The bytes.
        media_type: The value of ``Content-Type``.
    """

    body: bytes
    media_type: str


class File(NamedTuple):
    """A file and its media type."""

    path: Path
    media_type: str


def find_files(root: Path, prefix: str = "/") -> dict[str, File]:
    """Return the files below ``root`` of a known type by URL path; ``/`` is ``index.html``.

    A request can only name what is in here, so no path leads out of ``root``.
    """
    files = {
        prefix + path.relative_to(root).as_posix(): File(path, _MEDIA_TYPES[path.suffix])
        for path in sorted(root.rglob("*"))
        if path.suffix in _MEDIA_TYPES and path.is_file()
    }
    if "/index.html" in files:
        files["/"] = files["/index.html"]
    return files


def policy(files: Mapping[str, File], sources: Mapping[str, str]) -> str:
    """The ``Content-Security-Policy`` of a page; ``{host}`` is replaced by the request's ``Host``.

    Args:
        files: The page's files; the import maps of those in HTML are allowed.
        sources: What is allowed besides, by directive: ``{"connect-src": "blob:"}``.
    """
    allowed = dict(_SOURCES)
    maps = [
        text
        for path, file in files.items()
        if path.endswith(".html")
        for text in _IMPORT_MAP.findall(file.path.read_bytes())
    ]
    hashes = [("script-src", script_hash(text)) for text in maps]
    for directive, more in [*hashes, *sources.items()]:
        given = allowed.get(directive, "'none'")
        allowed[directive] = more if given == "'none'" else f"{given} {more}"
    return "; ".join(f"{directive} {value}" for directive, value in allowed.items())


def script_hash(script: bytes) -> str:
    """Return the source expression that allows a script by its text."""
    import base64
    import hashlib

    return f"'sha256-{base64.b64encode(hashlib.sha256(script).digest()).decode()}'"


def headers(policy: str, *, immutable: bool) -> dict[str, str]:
    """Return the headers of every answer; an ``immutable`` one is never asked for again."""
    return {
        "Content-Security-Policy": policy,
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cache-Control": "private, max-age=31536000, immutable" if immutable else "no-cache",
        "Connection": "close",
    }


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
