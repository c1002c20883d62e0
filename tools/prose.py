"""Rejects docstrings, comments and test names that break docs/style.md.

A docstring starts with a verb or a noun, not with "Whether" or "What". Some phrases are not
idiomatic English, or hide the noun that a reader needs. A file that a docstring names must exist.
The name of a test says what it tests.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
#: Neither tests nor programs that users write.
LEFT_OUT = re.compile(r"(^|/)(tests|benchmarks|lessons|exercises)/")
RIDDLE = re.compile(
    r"(Whether|What|Those|How|That|Which|Who|Whose|Where|When|Why|Until|Its|See|Of|Likewise)\b"
)
PHRASES = re.compile(
    r"\b(whoever|somebody|so many \w+s|for ever|anew|thus|mend(s|ed|ing)?|hangs? on (?!for)\w+"
    r"|there (is|are) none(?!, and none is needed)|those of|those who|is to be called|heard of"
    r"|listened to|known are|lacks|lacked|a damage|comes? of it|is not to be had|in what"
    r"|empty text|(?<!there )(is|are|was|were) no (?!longer|more|less|such|need|one\b|way)\w+)\b",
    re.IGNORECASE,
)
#: An entry of a `Raises:` section that does not name its subject.
NO_SUBJECT = re.compile(r"(?m)^ +\w+(?:Error|Exception): (?:It|One|They|There)\b")
RIDDLE_TEST = re.compile(r"test_(what|who|whoever|those|nobody|none|how|where|whether)_")
LONGEST_TEST = 70
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
        if path.endswith(".py") and (ROOT / path).is_file()
        for line, fault in _faults_in(path, names)
    ]
    print("\n".join(faults) if faults else "prose: all docstrings, comments and test names pass")
    return 1 if faults else 0


def _faults_in(path: str, names: set[str]) -> Iterator[tuple[int, str]]:
    source = (ROOT / path).read_text(encoding="utf-8")
    if path.rpartition("/")[2].startswith("test_"):
        yield from faults_of_tests(source)
    if not LEFT_OUT.search(path):
        yield from faults_of(source, names)


def faults_of_tests(source: str) -> Iterator[tuple[int, str]]:
    """Yield the line and the fault of each test whose name does not say subject and outcome."""
    for number, line in enumerate(source.splitlines(), 1):
        name = re.match(r" *(?:async )?def (test_\w+)", line)
        if name and RIDDLE_TEST.match(name[1]):
            yield number, f"name the subject and the outcome in {name[1]}"
        if name and len(name[1]) > LONGEST_TEST:
            yield number, f"{name[1]} has more than {LONGEST_TEST} characters"


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
        if opening := RIDDLE.match(text):
            yield line, f"the docstring starts with {opening[0]!r}: start with a verb or a noun"
        for phrase in PHRASES.finditer(text):
            yield line, f"the docstring says {phrase[0]!r}"
        if entry := NO_SUBJECT.search(text):
            yield line, f"name the subject in {entry[0].strip()!r}"
        for name in FILE.findall(text):
            if name not in names:
                yield line, f"the docstring names {name}, which does not exist"
    for number, text in enumerate(source.splitlines(), 1):
        if found := PHRASES.search(text.partition("# ")[2]):
            yield number, f"the comment says {found[0]!r}"


if __name__ == "__main__":
    sys.exit(main())
