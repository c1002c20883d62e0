"""Reads launch files in XML."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity

if TYPE_CHECKING:
    import io


class _Element(ET.Element):
    line = 0


class _Builder(ET.TreeBuilder):
    """Builds elements that know their lines."""

    def __init__(self) -> None:
        super().__init__(element_factory=_Element)
        self.parser: Any = None

    def start(self, tag: str, attributes: dict[str, str], /) -> ET.Element:
        element = super().start(tag, attributes)
        # The element is an _Element.
        element.line = self.parser.CurrentLineNumber  # type: ignore[attr-defined]
        return element


class Parser(BaseParser):
    """Reads launch files in XML, except documents that declare entities or refer to others."""

    @classmethod
    def load(cls, file: str | io.TextIOBase) -> tuple[Entity, Parser]:
        """Read a file into its root element.

        Raises:
            SyntaxError: The file is not XML, declares entities or is nested too deeply; the message
                names the file and, if known, the line.
        """
        from defusedxml.common import DTDForbidden
        from defusedxml.ElementTree import DefusedXMLParser, parse

        builder = _Builder()
        parser = DefusedXMLParser(target=builder, forbid_dtd=True)
        builder.parser = parser.parser
        name = os.path.basename(file if isinstance(file, str) else getattr(file, "name", ""))
        try:
            root: Any = parse(file, parser=parser).getroot()
            return Entity(root), cls()
        except DTDForbidden:
            text = "a document type declaration, which may hold entities, is not allowed here"
            raise SyntaxError(text, (name, builder.parser.CurrentLineNumber, None, None)) from None
        except RecursionError:
            raise SyntaxError("nested too deeply", (name, None, None, None)) from None
        except ET.ParseError as error:
            error.filename, error.lineno = name, error.position[0]
            raise

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        return {"xml"}
