"""Reads launch files in YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend import Parser as BaseParser
from launch_yaml.entity import Entity

if TYPE_CHECKING:
    import io

__all__ = ["Parser"]


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: str | io.TextIOBase) -> tuple[Entity, Parser]:
        """Read a file into its root element.

        Raises:
            yaml.YAMLError: It is no YAML.
            RuntimeError: It is no mapping with one key.
        """
        import yaml

        if isinstance(file, str):
            with open(file, encoding="utf-8") as opened:
                tree = yaml.safe_load(opened)
        else:
            tree = yaml.safe_load(file)
        if not isinstance(tree, dict) or len(tree) != 1:
            raise RuntimeError("Expected only one root element: a mapping with the key 'launch'")
        ((name, element),) = tree.items()
        return Entity(element, str(name)), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Suffixes of this language."""
        return {"yaml", "yml"}
