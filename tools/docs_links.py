"""Checks the HTML of a folder: links and anchors lead somewhere, nothing comes from elsewhere."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from html.parser import HTMLParser
from typing import TYPE_CHECKING
from urllib.parse import unquote, urlsplit

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator
    from pathlib import Path

#: Attributes of elements that a browser fetches without being asked.
FETCHED = {
    ("img", "src"),
    ("script", "src"),
    ("iframe", "src"),
    ("source", "src"),
    ("link", "href"),
}
#: Relations of <link> that a browser only knows of.
ONLY_NAMED = {"canonical", "author", "license", "next", "prev", "index", "search", "alternate"}
STYLE_ADDRESS = re.compile(r"""(?:url\(|@import\s+)\s*['"]?([^'")\s;]+)""")


@dataclass
class Document:
    """The links and anchors of one page."""

    anchors: set[str] = field(default_factory=set)
    links: list[str] = field(default_factory=list)
    fetched: list[str] = field(default_factory=list)
    base: str = ""


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.found = Document()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.found.anchors.update(values[name] for name in ("id", "name") if name in values)
        self.found.fetched += STYLE_ADDRESS.findall(values.get("style", ""))
        if tag == "base":
            self.found.base = values["href"]
        for name in ("href", "src"):
            if name not in values or tag == "base":
                continue
            named = tag == "link" and values.get("rel") in ONLY_NAMED
            kept = self.found.fetched if (tag, name) in FETCHED and not named else self.found.links
            kept.append(values[name])


def faults_of(folder: Path, apart: Collection[str] = ()) -> Iterator[str]:
    """Say what is wrong with the pages and style sheets of a folder.

    Args:
        folder: The site.
        apart: Folders in it whose own pages are not checked, only links to them.
    """
    pages = {}
    for path in sorted(folder.rglob("*")):
        if path.relative_to(folder).parts[0] in apart:
            continue
        if path.suffix == ".html":
            reader = _Reader()
            reader.feed(path.read_text(encoding="utf-8"))
            pages[path.resolve()] = reader.found
        elif path.suffix == ".css":
            fetched = STYLE_ADDRESS.findall(path.read_text(encoding="utf-8"))
            yield from _faults(folder, path, Document(fetched=fetched), {})
    for path, page in pages.items():
        yield from _faults(folder, path, page, pages)


def _faults(folder: Path, path: Path, page: Document, pages: dict[Path, Document]) -> Iterator[str]:
    where = path.relative_to(folder.resolve()) if path.is_absolute() else path
    for address in page.fetched:
        if address.startswith(("http:", "https:", "//")):
            yield f"{where}: loads {address} from elsewhere"
    for address in [*page.links, *page.fetched]:
        parts = urlsplit(address)
        if parts.scheme or parts.netloc:
            continue
        start = folder if page.base else path.parent
        target = (start / unquote(parts.path)).resolve() if parts.path else path
        if target.is_dir():
            target /= "index.html"
        anchors = pages[target].anchors if target in pages else None
        if not target.exists():
            yield f"{where}: {address} leads nowhere"
        elif parts.fragment and anchors is not None and unquote(parts.fragment) not in anchors:
            yield f"{where}: {address} does not exist on that page"
