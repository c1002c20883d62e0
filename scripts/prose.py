"""Refuses docstrings and comments that do not read like the documentation of other libraries.

A function's docstring starts with a verb, not with "Whether" or "What"; some phrases are not
English, or hide the noun that a reader needs; a file that a docstring names must exist.
docs/style.md says why.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).resolve().parent.parent
#: Neither tests nor programs that users write.
LEFT_OUT = re.compile(r"(^|/)(tests|benchmarks|lessons|exercises)/")
RIDDLE = re.compile(
    r"(Whether|What|Those|How|That|Which|Who|Whose|Where|When|Until|See|Of|Likewise)\b"
)
PHRASES = re.compile(
    r"\b(whoever|so many \w+s|for ever|mend(s|ed|ing)?|there is none(?!, and none is needed)"
    r"|those of|is to be called|a damage|comes? of it|is not to be had|in what)\b",
    re.IGNORECASE,
)
FILE = re.compile(r"(?<![\w/.<*-])[a-z][a-z_]+\.(?:py|cpp|hpp|js)\b")
#: Files of a user or of ROS 2 that docstrings give as examples.
EXAMPLES = {"setup.py", "conftest.py", "talker.py", "listener.py"}

Documented = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Module)


def main() -> int:
    """Print each fault with its place; the exit status."""
    listed = subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    names = {path.rpartition("/")[2] for path in listed} | EXAMPLES
    faults = [
        f"{path}:{line}: {fault}"
        for path in listed
        if path.endswith(".py") and not LEFT_OUT.search(path)
        for line, fault in faults_of((ROOT / path).read_text(encoding="utf-8"), names)
    ]
    print("\n".join(faults) if faults else "prose: all docstrings and comments pass")
    return 1 if faults else 0


def faults_of(source: str, names: set[str]) -> Iterator[tuple[int, str]]:
    """Yield the line and the fault of each docstring and comment of a module.

    Args:
        source: The module's text.
        names: Names of the files that docstrings may mention.
    """
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, Documented) or not (text := ast.get_docstring(node)):
            continue
        line = getattr(node, "lineno", 1)
        is_function = isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
        if is_function and (opening := RIDDLE.match(text)):
            yield line, f"the docstring starts with {opening[0]!r}: start with a verb"
        for phrase in PHRASES.finditer(text):
            yield line, f"the docstring says {phrase[0]!r}"
        for name in FILE.findall(text):
            if name not in names:
                yield line, f"the docstring names {name}, which does not exist"
    for number, text in enumerate(source.splitlines(), 1):
        if phrase := PHRASES.search(text.partition("# ")[2]):
            yield number, f"the comment says {phrase[0]!r}"


if __name__ == "__main__":
    sys.exit(main())
