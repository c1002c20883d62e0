"""XML as a tree of elements with their lines; entities and deep nesting raise errors.

The version of a URDF is 1.0, and in Lyrical also 1.1 or 1.2, which add attributes and shapes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.parsers import expat

from turtlewire.distro import LYRICAL, since
from turtlewire.errors import UrdfError
from turtlewire.urdf.faults import UrdfWarning

__all__ = [
    "MAX_DEPTH",
    "MAX_ELEMENTS",
    "Element",
    "check_version",
    "is_of_version",
    "minor_version",
    "parse_xml",
]

#: Elements within elements, as in TinyXML-2, which urdfdom reads with.
MAX_DEPTH = 500
MAX_ELEMENTS = 2_000_000


class Element:
    """An element of the file.

    Attributes:
        tag: Its name, with a namespace's prefix.
        attributes: Values by name.
        children: Elements directly below it; text is dropped.
        line: Where its start tag begins, from 1.
        parent: The element around it; None for the root.
    """

    __slots__ = ("attributes", "children", "line", "parent", "tag")

    def __init__(
        self, tag: str, attributes: dict[str, str], line: int, parent: Element | None
    ) -> None:
        self.tag = tag
        self.attributes = attributes
        self.line = line
        self.parent = parent
        self.children: list[Element] = []

    def get(self, name: str) -> str | None:
        """Return the value of an attribute, or None."""
        return self.attributes.get(name)

    def first(self, tag: str) -> Element | None:
        """Return the first child of this name, or None."""
        return next((child for child in self.children if child.tag == tag), None)

    def all(self, tag: str) -> Iterator[Element]:
        """Return all children of this name, in the order of the file."""
        return (child for child in self.children if child.tag == tag)

    def described(self) -> str:
        """Return the start tag with its name, within the nearest element that has a name."""
        text = self._start_tag()
        around = self.parent
        while "name" not in self.attributes and around is not None:
            if "name" in around.attributes or around.parent is None:
                return f"{text} in {around._start_tag()}"
            around = around.parent
        return text

    def error(self, text: str) -> UrdfError:
        """Return an error at this element."""
        return UrdfError(text, self.line, self.described())

    def _start_tag(self) -> str:
        name = self.attributes.get("name")
        return f"<{self.tag}>" if name is None else f'<{self.tag} name="{name}">'


class _Builder:
    def __init__(self, lines_before: int) -> None:
        self.parser = expat.ParserCreate()
        self.root: Element | None = None
        self.open: list[Element] = []
        self._lines_before = lines_before
        self._number = 0
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.EntityDeclHandler = self._entity

    @property
    def line(self) -> int:
        return self.parser.CurrentLineNumber + self._lines_before

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self.line, self.open[-1] if self.open else None)
        self._number += 1
        if len(self.open) >= MAX_DEPTH:
            raise element.error(f"Elements are nested more than {MAX_DEPTH} deep")
        if self._number > MAX_ELEMENTS:
            raise element.error(f"The file has more than {MAX_ELEMENTS} elements")
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def _end(self, _tag: str) -> None:
        self.open.pop()

    def _entity(self, name: str, *_: object) -> None:
        raise UrdfError(f"The declaration of the entity '{name}' is not allowed", self.line)


def parse_xml(text: str | bytes) -> Element:
    """Return the root element of an XML document.

    Args:
        text: The document; bytes are in the encoding that the XML declaration names, or UTF-8.
            White space before the declaration is accepted, as in TinyXML-2.

    Raises:
        UrdfError: The XML is not well-formed, declares entities or is nested too deeply.
    """
    stripped = text.lstrip()
    before = text[: len(text) - len(stripped)]
    lines = before.count("\n") if isinstance(before, str) else before.count(b"\n")
    builder = _Builder(lines)
    try:
        builder.parser.Parse(stripped, True)
    except expat.ExpatError as error:
        raise _xml_error(error, builder.open, lines) from None
    except (LookupError, UnicodeError) as error:  # an encoding that Python does not know
        raise UrdfError(str(error), builder.line) from None
    assert builder.root is not None, "expat demands a root element"
    return builder.root


def _xml_error(error: expat.ExpatError, opened: list[Element], lines_before: int) -> UrdfError:
    what = expat.ErrorString(error.code)
    unclosed = (expat.errors.XML_ERROR_TAG_MISMATCH, expat.errors.XML_ERROR_NO_ELEMENTS)
    if opened and what in unclosed:
        return opened[-1].error(f"The element <{opened[-1].tag}> is never closed")
    return UrdfError(f"The XML is not well-formed: {what}", error.lineno + lines_before)


_NEWEST_MINOR = 2


def check_version(root: Element) -> None:
    """Check the version of a ``robot`` element.

    Raises:
        UrdfError: This distribution does not read the version.
    """
    text = root.get("version")
    if text is None:
        return
    parts = text.split(".")
    if len(parts) != 2 or not all(part.isdecimal() for part in parts):
        raise root.error("The version attribute should be in the form 'x.y'")
    newest = _NEWEST_MINOR if since(LYRICAL) else 0
    if any(len(part) > 9 for part in parts) or not (int(parts[0]) == 1 and int(parts[1]) <= newest):
        known = (
            f"versions from 1.0 upto 1.{newest} are" if since(LYRICAL) else "only version 1.0 is"
        )
        raise root.error(f"Invalid 'version' specified; {known} currently supported")


def minor_version(element: Element) -> int:
    """Return the ``y`` of version ``1.y`` of the description that an element belongs to."""
    while element.parent is not None:
        element = element.parent
    found = re.fullmatch(r"1\.(\d+)", element.get("version") or "")
    return int(found[1]) if found else 0


def is_of_version(element: Element, minor: int, text: str, warnings: list[UrdfWarning]) -> bool:
    """Return whether a description has at least the version in which something came.

    Args:
        element: An element of the description.
        minor: The ``y`` of that version, ``1.y``.
        text: urdfdom's text in front of the version, for the warning in Lyrical.
        warnings: Gets the warning if the version is older.
    """
    if minor_version(element) >= minor:
        return True
    if since(LYRICAL):
        text = (
            f"Ignoring {text} URDF version 1.{minor} since specified version is"
            f" 1.{minor_version(element)}."
        )
        warnings.append(UrdfWarning(text, element.line, element.described()))
    return False
