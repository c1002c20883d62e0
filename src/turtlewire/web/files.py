"""The static files of a page, known by their paths when the server starts."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["File", "find_files"]

#: Suffix to media type. A page consists of nothing else.
_MEDIA_TYPES = {
    ".css": "text/css; charset=utf-8",
    ".html": "text/html; charset=utf-8",
    ".ico": "image/x-icon",
    ".js": "text/javascript; charset=utf-8",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}


class File(NamedTuple):
    """A file and its media type."""

    path: Path
    media_type: str


def find_files(root: Path) -> dict[str, File]:
    """URL path to file, for everything below ``root`` of a known type; ``/`` is ``index.html``.

    A request can only name what is in here, so no path leads out of ``root``.
    """
    files = {
        "/" + path.relative_to(root).as_posix(): File(path, _MEDIA_TYPES[path.suffix])
        for path in sorted(root.rglob("*"))
        if path.suffix in _MEDIA_TYPES and path.is_file()
    }
    if "/index.html" in files:
        files["/"] = files["/index.html"]
    return files
