"""Corrects what Sphinx and Furo write for screen readers, and reserves the space of images."""

from __future__ import annotations

import re
import struct
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the correction; Furo writes its part of a page before."""
    app.connect("html-page-context", correct_page, priority=900)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def correct_page(
    app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: object
) -> None:
    """Correct the parts of a page before they are put together."""
    if tree := context.get("furo_navigation_tree"):
        context["furo_navigation_tree"] = without_headings(tree)
    if body := context.get("body"):
        context["body"] = with_sizes(without_empty_terms(body), pictures(app))


def without_headings(tree: str) -> str:
    """Make the sidebar's captions plain text: a page's headings begin with its own title."""
    return tree.replace('<p class="caption" role="heading">', '<p class="caption">')


def without_empty_terms(body: str) -> str:
    """Hide the list in which Sphinx writes long signatures: it has definitions and no terms."""
    return re.sub(
        r'(<span class="sig-paren">\(</span>)\s*<dl>', r'\1<dl role="presentation">', body
    )


def pictures(app: Sphinx) -> dict[str, Path]:
    """Return the files of the site's images by the names that pages know them by."""
    return {name: Path(app.srcdir, path) for path, (_, name) in app.env.images.items()}


def with_sizes(body: str, files: dict[str, Path]) -> str:
    """Give images width and height, so that nothing moves when they arrive."""

    def sized(image: re.Match[str]) -> str:
        file = files.get(image[2].rpartition("/")[2])
        if file is None:
            return image[0]
        width, height = size_of(file)
        return f'{image[1]} width="{width}" height="{height}" />'

    return re.sub(r'(<img [^>]*?src="([^"]+)"[^>]*?)\s*/>', sized, body)


def size_of(file: Path) -> tuple[int, int]:
    """Return width and height of a PNG or SVG file in pixels.

    Raises:
        ValueError: The file has another format, or is an SVG without width and height.
    """
    content = file.read_bytes()
    if content.startswith(b"\x89PNG"):
        width, height = struct.unpack_from(">II", content, 16)
        return width, height
    found = re.search(rb'<svg [^>]*?width="(\d+)" height="(\d+)"', content)
    if not found:
        raise ValueError(f"{file} is neither a PNG nor an SVG with width and height")
    return int(found[1]), int(found[2])
