"""Reads launch files in YAML."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, Any

from launch.frontend import Parser as BaseParser
from launch_yaml.entity import Entity

if TYPE_CHECKING:
    import io

# With aliases, a few lines can expand to billions of elements; real launch files have far fewer.
_MOST_ELEMENTS = 100_000


class Parser(BaseParser):
    """Reads launch files in YAML."""

    @classmethod
    def load(cls, file: str | io.TextIOBase) -> tuple[Entity, Parser]:
        """Read a file into its root element.

        Raises:
            SyntaxError: The file is not YAML; the message names file and line.
            RuntimeError: The content is not a mapping with one key.
            ValueError: Its aliases contain themselves, or expand to more elements than a launch
                file has.
        """
        if isinstance(file, str):
            with open(file, encoding="utf-8") as opened:
                return cls.load(opened)
        tree = _tree(file)
        if not isinstance(tree, dict) or len(tree) != 1:
            raise RuntimeError("Expected only one root element: a mapping with the key 'launch'")
        if _size(tree, {}) > _MOST_ELEMENTS:
            raise ValueError(f"The aliases expand to more than {_MOST_ELEMENTS} elements")
        ((name, element),) = tree.items()
        return Entity(element, str(name)), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        return {"yaml", "yml"}


class _Mapping(dict):  # type: ignore[type-arg]
    """A mapping that knows its line."""

    line = 0


@cache
def _loader() -> Any:
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    def mapping(loader: Any, node: Any) -> Iterator[_Mapping]:
        made = _Mapping()
        made.line = node.start_mark.line + 1
        # Before it is filled, because it may contain an alias of itself.
        yield made
        made.update(loader.construct_mapping(node))

    Loader.add_constructor("tag:yaml.org,2002:map", mapping)
    return Loader


def _tree(file: io.TextIOBase) -> Any:
    import yaml

    name = os.path.basename(str(getattr(file, "name", "")))
    try:
        return yaml.load(file, _loader())  # noqa: S506  a SafeLoader
    except RecursionError:
        raise SyntaxError("nested too deeply", (name, None, None, None)) from None
    except ValueError as error:  # a date that is in no calendar
        raise SyntaxError(str(error), (name, None, None, None)) from None
    except yaml.MarkedYAMLError as error:
        if error.problem_mark is None:
            raise
        mark = error.problem_mark
        name = name or os.path.basename(mark.name)
        raise SyntaxError(
            str(error.problem), (name, mark.line + 1, mark.column + 1, None)
        ) from error


def _size(node: Any, known: dict[int, int | None]) -> int:
    """Return the number of elements with aliases written out; each node is visited once."""
    if not isinstance(node, (dict, list)):
        return 1
    if id(node) not in known:
        # Marks a node whose elements are being counted.
        known[id(node)] = None
        known[id(node)] = 1 + sum(
            _size(item, known) for item in (node.values() if isinstance(node, dict) else node)
        )
    size = known[id(node)]
    if size is None:
        raise ValueError("An alias contains itself")
    return size
