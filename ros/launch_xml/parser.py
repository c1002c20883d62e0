"""Reads launch files in XML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity

if TYPE_CHECKING:
    import io

__all__ = ["Parser"]


class Parser(BaseParser):
    """Reads launch files in XML. Documents that declare entities or refer to others are refused."""

    @classmethod
    def load(cls, file: str | io.TextIOBase) -> tuple[Entity, Parser]:
        """Read a file into its root element.

        Raises:
            xml.etree.ElementTree.ParseError: It is no XML.
            ValueError: It declares entities.
        """
        from defusedxml import ElementTree

        return Entity(ElementTree.parse(file, forbid_dtd=True).getroot()), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Suffixes of this language."""
        return {"xml"}
