"""Finds the error in a ``package.xml`` that cannot be read."""

from __future__ import annotations

from pathlib import Path
from xml.parsers import expat

__all__ = ["manifest_fault"]


def manifest_fault(path: str | Path) -> str | None:
    """The first error in the XML of a package.xml.

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
