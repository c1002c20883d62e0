"""The student's files as modules, imported afresh at each run."""

from __future__ import annotations

import contextlib
import linecache
import os
import sys
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["imported", "module_name"]


def module_name(file: str) -> str:
    """Name of the module that a file is imported as."""
    return os.path.splitext(file)[0]


@contextlib.contextmanager
def imported(files: Mapping[str, str]) -> Iterator[dict[str, ModuleType]]:
    """Run files as modules, in their order; they can import each other until the block ends.

    Args:
        files: Name to source text.

    Yields:
        The modules by file name.

    Raises:
        BaseException: Whatever the code raises.
    """
    modules: dict[str, ModuleType] = {}
    try:
        for file, source in files.items():
            # Tracebacks, and inspect, show the lines from here.
            lines = source.splitlines(keepends=True)
            linecache.cache[file] = (len(source), None, lines, file)
            module = ModuleType(module_name(file))
            module.__file__ = file
            modules[file] = sys.modules[module.__name__] = module
            exec(compile(source, file, "exec"), vars(module))  # noqa: S102 - it is what runs here
        yield modules
    finally:
        for module in modules.values():
            sys.modules.pop(module.__name__, None)
