"""Reads ``package.xml``, and finds the error in one that cannot be read."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat


class ManifestError(Exception):
    """A package.xml cannot be read; the text names the file, the line and the reason."""


class Manifest(NamedTuple):
    """The content of a package.xml.

    Attributes:
        name: The package.
        version: Its version.
        description: Its description, on one line.
        build_dependencies: Packages that its build needs.
    """

    name: str
    version: str
    description: str
    build_dependencies: tuple[str, ...]


def read_manifest(path: Path) -> Manifest:
    """Read a package.xml.

    Raises:
        ManifestError: The file is missing, is not XML, or has no name or version.
    """
    from defusedxml.ElementTree import parse

    if not path.is_file():
        raise ManifestError(f"there is no {path}")
    fault = manifest_fault(path)
    if fault is not None:
        raise ManifestError(fault)
    tree = parse(path)
    texts = {
        tag: " ".join((tree.findtext(tag) or "").split())
        for tag in ("name", "version", "description")
    }
    for tag in ("name", "version"):
        if not texts[tag]:
            raise ManifestError(f"{path} has no <{tag}>")
    dependencies = [
        element.text.strip()
        for tag in ("buildtool_depend", "build_depend", "depend")
        for element in tree.findall(tag)
        if element.text
    ]
    return Manifest(**texts, build_dependencies=tuple(dependencies))


def manifest_fault(path: str | Path) -> str | None:
    """Return the first error in the XML of a package.xml.

    Args:
        path: The file.

    Returns:
        ``<path>:<line>: <what>``, with the line in which an unclosed tag was opened; None when the
        XML is well-formed.

    Raises:
        OSError: The file cannot be read.
    """
    parser = expat.ParserCreate()
    opened: list[tuple[str, int]] = []

    def refuse(name: str, *_: object) -> None:
        raise ValueError(f"the declaration of the entity '{name}' is not allowed here")

    parser.EntityDeclHandler = refuse
    parser.StartElementHandler = lambda name, _: opened.append((name, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: opened.pop()
    try:
        parser.Parse(Path(path).read_bytes(), True)
    except (LookupError, ValueError) as error:
        return f"{path}:{parser.CurrentLineNumber}: {error}"
    except expat.ExpatError as error:
        if opened and expat.errors.messages[error.code] in (
            expat.errors.XML_ERROR_TAG_MISMATCH,
            expat.errors.XML_ERROR_NO_ELEMENTS,
        ):
            tag, line = opened[-1]
            return f"{path}:{line}: <{tag}> is never closed; remove it, or add </{tag}>"
        return f"{path}:{error.lineno}: {expat.ErrorString(error.code)}"
    return None
