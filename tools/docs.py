"""Builds the site: the pages of ``docs/``, the API reference, and the lesson below ``lesson/``.

Sphinx and what it needs are pinned in ``docs/sphinx/requirements.txt`` and live in
``build/docs-tools``, apart from ``.venv``. Warnings are errors, links and anchors are checked, and
a page that would load anything from elsewhere is refused: the site works without a network.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import early_options
from docs_releases import LIST, add_releases
from lesson import BuildError, is_replaceable, serve

from turtlewire.program import program

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


ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
DOCS = ROOT / "docs"
SOURCE = DOCS / "sphinx"
REQUIREMENTS = SOURCE / "requirements.txt"
TOOLS = BUILD / "docs-tools"
LESSON = BUILD / "lesson"
#: The lowest Python on which the pinned Sphinx runs.
OLDEST_PYTHON = (3, 11)


def main() -> int:
    """Build, and serve if asked to; the exit status."""
    options = early_options.docs(sys.argv[1:])
    started = time.monotonic()
    try:
        install_tools()
        if options.gettext:
            gather_texts(BUILD / "gettext")
            return 0
        build(options.output, options.language, options.base)
        if options.releases:
            built = add_releases(ROOT, options.output, options.base)
            print(f"{options.output}: releases: {', '.join(built) or 'none yet'}", flush=True)
        print(f"{options.output}: built in {time.monotonic() - started:.0f} s", flush=True)
        if options.serve:
            serve(options.output, options.port)
    except BuildError as error:
        print(f"scripts/docs: {error}", file=sys.stderr)
        return 1
    return 0


def install_tools() -> None:
    """Put Sphinx into ``build/docs-tools``, unless it is there as pinned.

    Raises:
        BuildError: This Python is too old, or pip failed.
    """
    if sys.version_info < OLDEST_PYTHON:
        raise BuildError(
            f"Sphinx needs Python {'.'.join(map(str, OLDEST_PYTHON))}; .venv has "
            f"{sys.version.split()[0]} (remove .venv, and PYTHON=python3.12 names another)"
        )
    wanted = hashlib.sha256(REQUIREMENTS.read_bytes() + sys.version.encode()).hexdigest()
    stamp = TOOLS / "stamp"
    if stamp.exists() and stamp.read_text(encoding="ascii") == wanted:
        return
    print("[docs] installing Sphinx into build/docs-tools", file=sys.stderr, flush=True)
    shutil.rmtree(TOOLS, ignore_errors=True)
    pip = [sys.executable, "-m", "pip", "install", "-q", "--disable-pip-version-check"]
    _checked([*pip, "--target", str(TOOLS), "-r", str(REQUIREMENTS)], dict(os.environ))
    stamp.write_text(wanted, encoding="ascii")


def build(output: Path, language: str = "en", base: str = "/") -> None:
    """Build the site into a folder, which is replaced, and check it.

    Raises:
        BuildError: Sphinx warns, a link leads nowhere, a page loads something from elsewhere, or
            the folder holds something else.
    """
    if not is_replaceable(output, "objects.inv"):
        raise BuildError(f"{output} is not a site that this script built, so it is not replaced")
    if language != "en" and not (SOURCE / "locale" / language).is_dir():
        raise BuildError(f"there is no translation in docs/sphinx/locale/{language}")
    settings = [f"-Dlanguage={language}", f"-Abase={base.rstrip('/')}/"]
    with tempfile.TemporaryDirectory(dir=BUILD) as folder:
        fresh = Path(folder) / "site"
        sphinx("html", fresh, *settings, caches=BUILD / f"docs-cache-{language}")
        if (LESSON / "manifest.json").exists():
            shutil.copytree(LESSON, fresh / "lesson")
            _link_back(fresh / "lesson" / "index.html")
        else:
            _without_lesson(fresh)
        (fresh / LIST).write_text("[]", encoding="ascii")
        if faults := list(faults_of(fresh, apart={"lesson"})):
            raise BuildError("\n".join(["the built pages have faults:", *faults]))
        shutil.rmtree(output, ignore_errors=True)
        output.parent.mkdir(parents=True, exist_ok=True)
        fresh.rename(output)


def _link_back(page: Path) -> None:
    """Show the lesson's link to the site; spaces keep the size that its manifest names."""
    text = page.read_text(encoding="utf-8")
    hidden = '<a id="site" href="../index.html" hidden>'
    if hidden not in text:
        raise BuildError(f"{page} has no hidden link to the site: rebuild it (scripts/lesson)")
    shown = hidden.replace("hidden", " " * len("hidden"))
    page.write_text(text.replace(hidden, shown), encoding="utf-8")


def _without_lesson(output: Path) -> None:
    print("[docs] without the lesson: scripts/lesson builds it; then run this again", flush=True)
    (output / "lesson").mkdir()
    shutil.copy(SOURCE / "no_lesson.html", output / "lesson" / "index.html")


def gather_texts(output: Path) -> None:
    """Write all texts as ``.pot`` files, which gettext's tools and translators' sites read."""
    sphinx("gettext", output, caches=BUILD / "docs-cache-gettext")
    print(f"{output}: {len(list(output.rglob('*.pot')))} files of texts")


def sphinx(builder: str, output: Path, *settings: str, caches: Path) -> None:
    """Run Sphinx; its warnings are errors.

    Raises:
        BuildError: The build failed; the message says why.
    """
    environment = {**os.environ, "PYTHONPATH": str(TOOLS), "PYTHONHASHSEED": "0"}
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-j", "auto"]
    folders = ["-c", str(SOURCE), "-d", str(caches), str(DOCS), str(output)]
    _checked([*command, "-b", builder, *settings, *folders], environment)


def _checked(command: list[str], environment: dict[str, str]) -> None:
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        said = "\n".join(line for line in (done.stdout + done.stderr).splitlines() if line)
        raise BuildError(f"this failed: {' '.join(command[1:4])}\n{said}")


if __name__ == "__main__":
    sys.exit(program(main)())
