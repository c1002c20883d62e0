"""The student's files as modules, imported afresh at each run; the solution of a lesson."""

from __future__ import annotations

import contextlib
import linecache
import os
import re
import sys
from collections.abc import Iterator, Mapping
from types import ModuleType

__all__ = ["imported", "module_name", "solved"]


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


def solved(starter: Mapping[str, str], diff: str) -> dict[str, str]:
    """Return the files of a lesson with the changes of a unified diff.

    The line numbers of a hunk do not count: its old lines must occur exactly once in the file, so
    that a change of the first files cannot move the solution to another line unnoticed.

    Args:
        starter: Source texts by file name.
        diff: The changes, as ``diff -u`` prints them.

    Raises:
        ValueError: The old lines of a hunk do not occur exactly once.
    """
    files = dict(starter)
    for file, old, new in _hunks(diff):
        if (count := files[file].count(old)) != 1:
            raise ValueError(f"{file} has {count} of these lines, expected 1:\n{old}")
        files[file] = files[file].replace(old, new)
    return files


def _hunks(diff: str) -> Iterator[tuple[str, str, str]]:
    """Yield the file, the old and the new lines of each hunk."""
    for section in re.split(r"^--- .*\n", diff, flags=re.MULTILINE)[1:]:
        head, *hunks = re.split(r"^@@.*\n", section, flags=re.MULTILINE)
        file = head.strip().rpartition("/")[2]
        for hunk in hunks:
            lines = [line or " " for line in hunk.splitlines()]  # editors strip the last space
            yield file, _side(lines, "-"), _side(lines, "+")


def _side(lines: list[str], sign: str) -> str:
    return "".join(f"{line[1:]}\n" for line in lines if line[0] in {" ", sign})
