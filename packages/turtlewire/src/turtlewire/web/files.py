"""The files of a page, found when the server starts, and the headers of its responses.

A page may hold import maps, ``<script type="importmap">``: the only scripts that must be inline.
The policy allows them by their hashes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

__all__ = ["File", "WebContent", "find_files", "headers", "policy", "script_hash"]

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
