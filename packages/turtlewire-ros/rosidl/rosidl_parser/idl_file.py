"""Files of interfaces in IDL: their paths and contents."""

from __future__ import annotations

import pathlib
from typing import Any, TypeVar

_Element = TypeVar("_Element")


class Include:
    """A note that a file needs another one.

    Attributes:
        locator: The other file, for example ``std_msgs/msg/Header.idl``.
    """

    __slots__ = ("locator",)

    def __init__(self, locator: str) -> None:
        self.locator = locator


class IdlLocator:
    """The path of a file.

    Attributes:
        basepath: A folder.
        relative_path: The path below it.
    """

    __slots__ = ("basepath", "relative_path")

    def __init__(self, basepath: pathlib.Path, relative_path: pathlib.Path) -> None:
        self.basepath = pathlib.Path(basepath)
        self.relative_path = pathlib.Path(relative_path)

    def get_absolute_path(self) -> pathlib.Path:
        """Return folder and path together."""
        return self.basepath / self.relative_path


class IdlContent:
    """The content of a file.

    Attributes:
        elements: Includes, messages, services and actions.
    """

    __slots__ = ("elements",)

    def __init__(self) -> None:
        self.elements: list[Any] = []

    def get_elements_of_type(self, type_: type[_Element]) -> list[_Element]:
        """Return the elements of a class."""
        return [each for each in self.elements if isinstance(each, type_)]


class IdlFile:
    """A file and what it holds.

    Attributes:
        locator: Where it is.
        content: The content of it.
    """

    __slots__ = ("content", "locator")

    def __init__(self, locator: IdlLocator, content: IdlContent) -> None:
        self.locator = locator
        self.content = content
