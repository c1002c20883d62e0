"""Reads launch files in XML."""

from __future__ import annotations

import os
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
            SyntaxError: It is no XML; names file and line.
            ValueError: It declares entities.
        """
        from defusedxml import ElementTree

        try:
            root = ElementTree.parse(file, forbid_dtd=True).getroot()
        except ElementTree.ParseError as error:
            path = file if isinstance(file, str) else getattr(file, "name", "")
            error.filename, error.lineno = os.path.basename(path), error.position[0]
            raise
        return Entity(root), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Suffixes of this language."""
        return {"xml"}
